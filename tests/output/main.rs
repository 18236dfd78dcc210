//! What goes out of the crate can be read back: every digit in CSV, a line with its data in VTK, the same values in JSON.
#![allow(clippy::unwrap_used)] // a test that cannot go on should panic

use hyperrod::load::DeadWrench;
use hyperrod::output::{Polyline, write_csv};
use hyperrod::section::Stiffness;
use hyperrod::solve::Node;
use hyperrod::{Body, Pose, Rod, StaticSolution, Statics};
use nalgebra::{Isometry3, UnitQuaternion, Vector3, vector};

/// A rod bent and twisted out of its plane, with a point load, so that two nodes share one place.
fn solved() -> StaticSolution {
    let body = Body::new(0.8, Stiffness::diagonal([1.0, 1.3, 0.8, 1e4, 1e4, 3e4]).unwrap()).unwrap();
    let tip = DeadWrench::new(vector![0.1, 0.2, 0.3], vector![0.7, -0.4, 0.5]).unwrap();
    let rod = Rod::clamped(body, Pose::identity())
        .with_tip_load(tip)
        .with_point_load(0.3, DeadWrench::force(vector![0.0, 0.5, 0.0]).unwrap())
        .unwrap();
    Statics { elements: 4, ..Statics::default() }.solve(&rod).unwrap()
}

/// Reading the text gives the very numbers: the tolerance of strains and wrenches is zero. The quaternion is a rounding away from R.
#[test]
fn a_table_has_every_digit_of_the_nodes() {
    let solution = solved();
    let mut text = Vec::new();
    write_csv(&mut text, solution.nodes()).unwrap();
    let text = String::from_utf8(text).unwrap();
    let columns = text.lines().next().unwrap().split(',').count();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').map(|v| v.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), solution.nodes().len());
    for (row, node) in rows.iter().zip(solution.nodes()) {
        assert_eq!((row.len(), columns), (20, 20));
        let p = node.pose.position;
        assert_eq!(row[..4], [node.s, p.x, p.y, p.z]);
        assert_eq!(row[8..14], node.strain.to_array());
        assert_eq!(row[14..], node.wrench.to_array());
        let q = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(row[4], row[5], row[6], row[7]));
        let error = (q.to_rotation_matrix().into_inner() - node.pose.rotation).amax();
        assert!(error < 1e-14, "rotation off by {error:e}");
    }
}

/// The numbers of one array of the file.
fn array(text: &str, name: &str) -> Vec<f64> {
    let start = text.find(&format!("Name=\"{name}\"")).unwrap_or_else(|| panic!("no {name}"));
    let body = &text[start + text[start..].find('>').unwrap() + 1..];
    body[..body.find('<').unwrap()].split_whitespace().map(|v| v.parse().unwrap()).collect()
}

#[test]
fn a_line_of_vtk_has_points_connectivity_and_vectors_in_space() {
    let solution = solved();
    let mut file = Vec::new();
    let line = Polyline::new(solution.nodes()).with_radius(|s| 0.02 - 0.01 * s);
    line.with_scalar("a < b & \"c\"", |_| f64::INFINITY).write(&mut file).unwrap();
    let (text, count) = (String::from_utf8(file).unwrap(), solution.nodes().len());
    assert!(text.contains(&format!("NumberOfPoints=\"{count}\"")));
    assert_eq!(array(&text, "connectivity"), (0..count).map(|k| k as f64).collect::<Vec<_>>());
    assert_eq!(array(&text, "offsets"), [count as f64]);
    assert!(array(&text, "a &lt; b &amp; &quot;c&quot;").iter().all(|v| v.is_nan()));
    for (k, node) in solution.nodes().iter().enumerate() {
        let vector = |name: &str| Vector3::from_column_slice(&array(&text, name)[3 * k..3 * k + 3]);
        assert_eq!(vector("Points"), node.pose.position);
        assert_eq!(vector("force"), node.pose.rotation * node.wrench.force);
        assert_eq!(vector("moment_body"), node.wrench.moment);
        assert_eq!(array(&text, "radius")[k], 0.02 - 0.01 * node.s);
    }
}

#[test]
fn a_file_of_no_nodes_is_a_file() {
    let mut file = Vec::new();
    Polyline::new(&[]).with_radius(|_| 1.0).write(&mut file).unwrap();
    let text = String::from_utf8(file).unwrap();
    assert!(text.contains("NumberOfLines=\"0\"") && array(&text, "radius").is_empty());
}

/// A rotation matrix and its quaternion agree to a few roundings.
#[test]
fn a_pose_goes_to_an_isometry_and_back() {
    for Node { pose, .. } in solved().nodes() {
        let back = Pose::from(Isometry3::from(*pose));
        assert_eq!(back.position, pose.position);
        assert!((back.rotation - pose.rotation).amax() < 1e-14);
    }
}

/// ∫ds = L and the moment of the point load, with two nodes at the place of the load: the weights are those of the elements.
#[test]
fn an_integral_over_a_rod_with_a_joint_counts_its_elements_alone() {
    let solution = solved();
    // Gauss weights sum to 1: rounding of four products
    assert!((solution.integrate(|_| 1.0) - 0.8).abs() < 1e-15);
    // two stages are exact for s³
    assert!((solution.integrate(|node| node.s.powi(3)) - 0.8_f64.powi(4) / 4.0).abs() < 1e-15);
}

#[cfg(feature = "serde")]
mod json {
    use super::solved;
    use hyperrod::load::Gravity;
    use hyperrod::material::NeoHookean;
    use hyperrod::section::{Circle, Section};
    use hyperrod::solve::dynamics::{Dynamics, Frame, Scene, Start};
    use hyperrod::solve::{Node, Report};
    use hyperrod::{Body, Pose, Rod, Strain, Twist, Wrench};
    use nalgebra::vector;

    /// With every bit kept by the format (`float_roundtrip`), what is read is what was written.
    #[test]
    fn nodes_and_report_are_read_as_they_were_written() {
        let solution = solved();
        let text = serde_json::to_string(&solution).unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        let nodes: Vec<Node> = serde_json::from_value(value["nodes"].clone()).unwrap();
        let stages: Vec<Node> = serde_json::from_value(value["stages"].clone()).unwrap();
        let report: Report = serde_json::from_value(value["report"].clone()).unwrap();
        assert_eq!((&nodes[..], &stages[..]), (solution.nodes(), solution.stages()));
        assert_eq!(&report, solution.report());
    }

    #[test]
    fn the_fields_have_the_names_of_the_types_and_rotations_are_rows() {
        let node = solved().nodes()[2];
        let value = serde_json::to_value(node).unwrap();
        assert_eq!(value["pose"]["rotation"][0][2], node.pose.rotation[(0, 2)]);
        assert_eq!(value["wrench"]["force"][1], node.wrench.force.y);
        assert_eq!(value["strain"]["angular"][2], node.strain.angular.z);
        let xi = Twist::straight();
        assert_eq!(serde_json::from_str::<Twist>(&serde_json::to_string(&xi).unwrap()).unwrap(), xi);
        assert!(serde_json::from_str::<Strain>("{\"angular\":[1,2]}").is_err());
        assert!(serde_json::from_str::<Wrench>("{\"moment\":[1,2,3],\"force\":[4,5,6]}").is_ok());
    }

    #[test]
    fn a_frame_of_a_rod_in_motion_is_read_as_it_was_written() {
        let law = NeoHookean::new(50e3, 50e3).unwrap();
        let section = Section::new(Circle::new(5e-3), law).unwrap();
        let body = Body::new(0.2, section).unwrap().with_density(1000.0).unwrap();
        let rod =
            Rod::clamped(body, Pose::identity()).with_load(Gravity::new(vector![9.81, 0.0, 0.0]).unwrap());
        let scene = Scene::new(&rod);
        let dynamics = Dynamics { elements: 4, ..Dynamics::default() };
        let mut stepper = dynamics.start(&scene, &Start::at_rest()).unwrap();
        stepper.step_toward(0.01).unwrap();
        let frame = stepper.frame().unwrap();
        assert!(frame.linear_momentum.norm() > 1e-6);
        let text = serde_json::to_string(&frame).unwrap();
        assert_eq!(serde_json::from_str::<Frame>(&text).unwrap(), frame);
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["linear_momentum"][0], frame.linear_momentum.x);
    }

    #[test]
    fn a_matrix_that_is_no_rotation_is_no_pose() {
        for third in ["0,0,-1", "0,0,1.1", "0,1,0"] {
            let text = format!("{{\"rotation\":[[1,0,0],[0,1,0],[{third}]],\"position\":[0,0,0]}}");
            let error = serde_json::from_str::<Pose>(&text).unwrap_err();
            assert!(error.to_string().contains("no rotation"), "{error}");
        }
    }
}
