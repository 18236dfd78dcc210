//! Poses and vectors written and read by serde: `{"rotation": [row, row, row], "position": [x, y, z]}`, `{"moment": [..], "force": [..]}`.

use nalgebra::{Matrix3, Vector3};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Pose, Strain, Twist, Wrench};

/// How far RᵀR may be from I for R to be read as a rotation: rotations written with six digits pass.
const ORTHOGONAL: f64 = 1e-5;

#[derive(Serialize, Deserialize)]
#[serde(rename = "Pose")]
struct PoseRows {
    rotation: [[f64; 3]; 3],
    position: [f64; 3],
}

impl Serialize for Pose {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rotation = self.rotation.transpose().into();
        PoseRows { rotation, position: self.position.into() }.serialize(serializer)
    }
}

/// Refuses a matrix that is no rotation.
impl<'de> Deserialize<'de> for Pose {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let PoseRows { rotation, position } = PoseRows::deserialize(deserializer)?;
        let rotation = Matrix3::from(rotation).transpose();
        let error = (rotation.tr_mul(&rotation) - Matrix3::identity()).amax();
        if !(error < ORTHOGONAL && rotation.determinant() > 0.0) {
            return Err(D::Error::custom(format!(
                "rotation of a pose is no rotation: RᵀR is {error:e} from I"
            )));
        }
        Ok(Self::new(rotation, Vector3::from(position)))
    }
}

macro_rules! as_pair {
    ($name:ident, $first:ident, $second:ident, $fields:ident, $title:literal) => {
        #[derive(Serialize, Deserialize)]
        #[serde(rename = $title)]
        struct $fields {
            $first: [f64; 3],
            $second: [f64; 3],
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $fields { $first: self.$first.into(), $second: self.$second.into() }.serialize(serializer)
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let $fields { $first, $second } = $fields::deserialize(deserializer)?;
                Ok(Self::new($first.into(), $second.into()))
            }
        }
    };
}

as_pair!(Twist, angular, linear, TwistFields, "Twist");
as_pair!(Strain, angular, linear, StrainFields, "Strain");
as_pair!(Wrench, moment, force, WrenchFields, "Wrench");

/// A vector of space as `[x, y, z]`, for `#[serde(with = ..)]`.
pub(crate) mod vector {
    use super::{Deserialize, Deserializer, Serialize, Serializer, Vector3};

    pub(crate) fn serialize<S: Serializer>(vector: &Vector3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        <[f64; 3]>::from(*vector).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vector3<f64>, D::Error> {
        <[f64; 3]>::deserialize(deserializer).map(Vector3::from)
    }
}
