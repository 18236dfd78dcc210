//! Questions three laws on a circle, prints the reports, and plots the wrench against each strain, shaded where the tangent is not
//! positive definite or the strain is refused: `target/hyperrod/material_check/*.svg`.

use std::error::Error;
use std::path::{Path, PathBuf};

use hyperrod::Strain;
use hyperrod::material::{Gent, Material, SaintVenantKirchhoff, Station, Yeoh};
use hyperrod::section::{CheckOptions, CheckReport, Circle, CrossSection, Section, check};
use plotters::prelude::*;

const RADIUS: f64 = 0.01;
const LARGEST: f64 = 1.5;

/// Name, unit and conjugate of each strain.
const AXES: [[&str; 3]; 6] = [
    ["bending about x, omega_x R", "m_x", "mN m"],
    ["bending about y, omega_y R", "m_y", "mN m"],
    ["twist, omega_z R", "m_z", "mN m"],
    ["shear, nu_x", "n_x", "N"],
    ["shear, nu_y", "n_y", "N"],
    ["stretch, nu_z", "n_z", "N"],
];

#[expect(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/hyperrod/material_check");
    std::fs::create_dir_all(&folder)?;
    let laws: [(&str, Box<dyn Material>); 3] = [
        ("saint_venant_kirchhoff", Box::new(SaintVenantKirchhoff::new(170e3, 400e3)?)),
        ("gent", Box::new(Gent::new(170e3, 400e3, 1.5)?)),
        ("yeoh", Box::new(Yeoh::new([85e3, -40e3, 12e3], [200e3, 0.0, 0.0])?)),
    ];
    let count = laws.len();
    for (name, law) in laws {
        let shape = Circle::new(RADIUS);
        let options = CheckOptions { largest_strain: LARGEST, ..Default::default() };
        let report = check(&shape, &law, &options)?;
        println!("{name} on a circle of {RADIUS} m\n{report}\n");
        let section = Section::new(shape, law)?.with_degree(60)?;
        plot(&folder.join(format!("{name}.svg")), name, &section, &report)?;
    }
    println!("material_check: {count} laws, plots in {}", folder.display());
    Ok(())
}

/// The wrench component conjugate to strain `axis`, where the section admits it.
fn curve(section: &dyn CrossSection, axis: usize) -> Vec<(f64, f64)> {
    let at = Station::straight(0.0);
    let steps = -300..=300;
    let component = |strain: f64| {
        let mut xi = [0.0; 6];
        xi[axis] = if axis < 3 { strain / RADIUS } else { strain };
        section.wrench(&at, &Strain::from_array(xi)).ok()
    };
    let strains = steps.map(|step| LARGEST * f64::from(step) / 300.0);
    let scale = if axis < 3 { 1e3 } else { 1.0 };
    strains.filter_map(|strain| Some((strain, scale * component(strain)?.to_array()[axis]))).collect()
}

/// The middle nine tenths of what the curve takes on, so that a pole does not flatten the rest.
fn height(curve: &[(f64, f64)]) -> f64 {
    let mut sizes: Vec<f64> = curve.iter().map(|point| point.1.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    1.2 * sizes.get(sizes.len() * 9 / 10).copied().unwrap_or(1.0).max(1e-9)
}

fn plot(
    path: &PathBuf,
    name: &str,
    section: &dyn CrossSection,
    report: &CheckReport,
) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(path, (1200, 720)).into_drawing_area();
    root.fill(&WHITE)?;
    let title = format!(
        "{}: wrench against each strain; grey: tangent not positive definite, or strain refused",
        name.replace('_', " ")
    );
    let root = root.titled(&title, ("sans-serif", 20))?;
    for (axis, panel) in root.split_evenly((2, 3)).iter().enumerate() {
        let [strain, component, unit] = AXES[axis];
        let curve = curve(section, axis);
        let top = height(&curve);
        let mut chart = ChartBuilder::on(panel)
            .margin(12)
            .x_label_area_size(36)
            .y_label_area_size(64)
            .build_cartesian_2d(-LARGEST..LARGEST, -top..top)?;
        let range = &report.ranges[axis];
        // from the strain at the outermost quadrature point to that at the rim
        let to_rim = if axis < 3 { RADIUS / range.length } else { 1.0 };
        let [lower, upper] = [&range.lower, &range.upper].map(|bound| bound.strain() * to_rim);
        for (from, to) in [(-LARGEST, lower), (upper, LARGEST)] {
            if from < to {
                let shade = Rectangle::new([(from, -top), (to, top)], RGBColor(220, 220, 220).filled());
                chart.draw_series(std::iter::once(shade))?;
            }
        }
        chart
            .configure_mesh()
            .x_desc(strain)
            .y_desc(format!("{component} ({unit})"))
            .x_labels(7)
            .y_labels(7)
            .light_line_style(TRANSPARENT)
            .draw()?;
        let inside = curve.into_iter().filter(|point| point.1.abs() <= top);
        chart.draw_series(LineSeries::new(inside, BLUE.stroke_width(2)))?;
    }
    root.present()?;
    Ok(())
}
