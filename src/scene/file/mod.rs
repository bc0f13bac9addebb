//! The scene file: TOML in which every key is optional.
//!
//! What is read here is not yet checked: [`SceneFile::resolve`] does that, for values from files and from command-line
//! flags alike.

mod check;
mod choices;
pub mod diagnostics;
mod lights;
mod overlay;
pub mod resolve;
#[cfg(test)]
mod tests;
pub mod value;
mod viewpoint;
mod visibility;

pub use choices::{NormalChoice, VisibilityChoice};
pub use lights::{FalloffChoice, LightSection, ViewerChoice};

use super::{
    Clipping, Culling, DepthSource, Interpolation, PainterKey, Scene, SpecularGate, SpecularModel,
};
use crate::mesh::Material;
use crate::picture::Encoding;
use diagnostics::{SceneError, SourceText};
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};
use std::fmt;
use std::format;
use std::path::Path;
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec::Vec;
use value::{Located, OneOrThree, Origin, shortest};

/// A scene as it is written: TOML whose keys are the names of these fields.
///
/// Angles are in degrees, lengths in world units, colours linear. Two scene files are equal when they say the same,
/// wherever it stands.
#[derive(Clone, Debug, Default, PartialEq, serde::Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// A name for captions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<Located<String>>,
    /// What there is to see.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<Located<String>>,
    /// Ambient intensity `I_a`, 0 or more: one number or red, green, blue. Default: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ambient: Option<Located<OneOrThree>>,
    /// `"screen"` (the lecture's, default) or `"perspective"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<Located<Interpolation>>,
    /// Where the eye is for the highlights: `"infinite"`, at infinity along the line of sight (the lecture's, default), or
    /// `"local"`, where the camera is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viewer: Option<Located<ViewerChoice>>,
    /// The cosine of the highlights: `"phong"` (R·V, the lecture's, default) or `"blinn"` (N·H).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub specular: Option<Located<SpecularModel>>,
    /// The cosine that `shininess` is meant for, `"phong"` or `"blinn"`: where it is not that of `specular`, exponents
    /// are converted, four times as large for N·H. Default: that of `specular`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shininess_for: Option<Located<SpecularModel>>,
    /// Highlights where the light is behind the surface: `"gated"` (none, default), `"ungated"`, or `"weighted"` by L·N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub specular_gate: Option<Located<SpecularGate>>,
    /// Which polygons are left out: `"back"` (default), `"front"` or `"none"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cull: Option<Located<Culling>>,
    /// What hides a polygon: `"z-buffer"` (default), `"painter"` or `"draw-order"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub visibility: Option<Located<VisibilityChoice>>,
    /// Bits of the depth buffer: 16, 24 or 32 (default).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth_bits: Option<Located<i64>>,
    /// Where depth comes from: `"interpolated"` (default) or `"per-sample"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<Located<DepthSource>>,
    /// By what the painter sorts: `"mean"` (default) or `"farthest"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub painter_key: Option<Located<PainterKey>>,
    /// What keeps polygons within the view: `"planes"` (default) or `"ndc-cube"`, CS171's test of each pixel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clipping: Option<Located<Clipping>>,
    /// True if polygons seen from behind are lit with negated normals. Default: false.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub two_sided: Option<Located<bool>>,
    /// Size and encoding of the picture.
    #[serde(default, skip_serializing_if = "ImageSection::is_empty")]
    pub image: ImageSection,
    /// Where the scene is seen from.
    #[serde(default, skip_serializing_if = "CameraSection::is_empty")]
    pub camera: CameraSection,
    /// The material of all that has none of its own.
    #[serde(default, skip_serializing_if = "MaterialSection::is_empty")]
    pub material: MaterialSection,
    /// Lights. Default: one white light from the upper right; `light = []` means ambient light only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub light: Option<Vec<LightSection>>,
    /// What is drawn, in this order; at least one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub object: Vec<ObjectSection>,
    #[serde(skip)]
    pub(super) source: Source,
}

/// The file that a scene was read from, if it was: no part of what the scene says.
#[derive(Clone, Debug, Default)]
pub(super) struct Source(pub Option<Arc<SourceText>>);

impl PartialEq for Source {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Declares a section of a scene file: a table whose keys are all optional.
macro_rules! section {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Deserialize, serde::Serialize)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $(
                $(#[$field_doc])*
                #[serde(default, skip_serializing_if = "Option::is_none")]
                pub $field: Option<Located<$type>>,
            )*
        }

        impl $name {
            /// True if no key is given.
            pub fn is_empty(&self) -> bool {
                $(self.$field.is_none())&&*
            }

            /// What is given here, and `other` where nothing is.
            pub fn or(self, other: &Self) -> Self {
                $name { $($field: self.$field.or_else(|| other.$field.clone()),)* }
            }
        }
    };
}

section! {
    /// `[image]`: size and encoding of the picture.
    ImageSection {
        /// Texels a row, 1 to 16,384. Default: 640.
        width: i64,
        /// Rows, 1 to 16,384. Default: 480.
        height: i64,
        /// Colour where nothing is drawn, 0 to 1: one number or red, green, blue. Default: 0.
        background: OneOrThree,
        /// How values are stored in eight bits: `"linear"` (default) or `"srgb"`.
        encoding: Encoding,
        /// Samples a pixel along each side: 1 (default), 2, 4 or 8.
        samples: i64,
    }
}

section! {
    /// `[camera]`: where the scene is seen from.
    ///
    /// With `eye` and without `fit` the camera stands where it is told to. Otherwise it is fitted: it looks at the
    /// middle of the bounding box of all objects, from a direction that `direction`, `azimuth` and `elevation`, or `eye`
    /// and `target` give, and the objects fill the part `fit` of the frame.
    CameraSection {
        /// Position of the eye.
        eye: [f64; 3],
        /// The point in the middle of the picture. Default: the origin.
        target: [f64; 3],
        /// The direction that is upward in the picture. Default: y, or away from the viewer in a view along y.
        up: [f64; 3],
        /// Orthographic: half of the height that is seen. Default: such that the objects fill 0.8 of the frame.
        half_height: f64,
        /// Perspective: the vertical field of view in degrees, over 0 and under 180.
        fovy: f64,
        /// Distance of the near plane along the line of sight. Default: before the objects by 5 % of their depth.
        near: f64,
        /// Distance of the far plane. Default: behind the objects by 5 % of their depth.
        far: f64,
        /// The part of the frame that the objects fill, 0.001 to 100. Default, without `eye`: 0.8.
        fit: f64,
        /// From the objects toward the eye. Default: a three-quarter view, (0.5, 0.3, 1).
        direction: [f64; 3],
        /// Instead of `direction`: degrees around the y axis, from z toward x. Default: 0.
        azimuth: f64,
        /// Instead of `direction`: degrees above the horizon, −90 to 90. Default: 0.
        elevation: f64,
    }
}

section! {
    /// `[material]`, or `material` of an object: the coefficients of L21 2.1.
    MaterialSection {
        /// Ambient reflection `k_a`, 0 or more: one number or red, green, blue.
        ka: OneOrThree,
        /// Diffuse reflection `k_d`.
        kd: OneOrThree,
        /// Specular reflection `k_s`.
        ks: OneOrThree,
        /// The exponent `n`, 0 or more.
        shininess: f64,
    }
}

/// `[[object]]`: a mesh somewhere in the world. It is scaled, then rotated, then translated.
#[derive(Clone, Debug, PartialEq, serde::Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectSection {
    /// An OBJ file (relative to the scene file), or `builtin:NAME`, or `builtin:NAME?key=value&key=value`.
    pub mesh: Located<String>,
    /// Where vertex normals come from: `"averaged"` (default: L21 3.1, whatever the mesh brings) or `"given"` (those of
    /// the mesh, averaged ones where it has none).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normals: Option<Located<NormalChoice>>,
    /// Instead of `normals`: average over polygons whose normals differ by at most so many degrees, 0 to 180.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crease: Option<Located<f64>>,
    /// One factor or three, none of them 0; a negative one mirrors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Located<OneOrThree>>,
    /// A rotation, or a list of them, of which the first is done first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotate: Option<Rotations>,
    /// Where the origin of the mesh comes to lie.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translate: Option<Located<[f64; 3]>>,
    /// Instead of the three above: three rows of four numbers, the last of each being the translation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix: Option<Located<[[f64; 4]; 3]>>,
    /// Replaces the materials of the mesh; keys that are absent here are those of `[material]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<MaterialSection>,
}

impl ObjectSection {
    /// A mesh as it is.
    pub fn new(mesh: impl Into<Located<String>>) -> Self {
        ObjectSection {
            mesh: mesh.into(),
            normals: None,
            crease: None,
            scale: None,
            rotate: None,
            translate: None,
            matrix: None,
            material: None,
        }
    }
}

/// One rotation, counter-clockwise for who looks against the axis.
#[derive(Clone, Debug, PartialEq, serde::Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct RotationSection {
    /// The axis through the origin; any length but 0.
    pub axis: Located<[f64; 3]>,
    /// The angle in degrees.
    pub angle: Located<f64>,
}

/// Rotations, of which the first is done first; a single one is written without brackets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rotations(pub Vec<RotationSection>);

impl<'de> Deserialize<'de> for Rotations {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct RotationsVisitor;
        impl<'de> Visitor<'de> for RotationsVisitor {
            type Value = Rotations;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("{ axis = [x, y, z], angle = degrees } or a list of those")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Rotations, A::Error> {
                let rotation = RotationSection::deserialize(
                    serde::de::value::MapAccessDeserializer::new(map),
                )?;
                Ok(Rotations([rotation].into()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Rotations, A::Error> {
                Vec::deserialize(serde::de::value::SeqAccessDeserializer::new(seq)).map(Rotations)
            }
        }
        deserializer.deserialize_any(RotationsVisitor)
    }
}

impl Serialize for Rotations {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [rotation] => rotation.serialize(serializer),
            rotations => rotations.serialize(serializer),
        }
    }
}

impl SceneFile {
    /// Width and height of a picture when nothing else is said.
    pub const DEFAULT_SIZE: (u32, u32) = Scene::DEFAULT_SIZE;
    /// The part of the frame that objects fill when nothing else is said.
    pub const DEFAULT_FIT: f64 = Scene::DEFAULT_FIT;
    /// From the objects toward the eye when nothing else is said: a three-quarter view.
    pub const DEFAULT_DIRECTION: [f64; 3] = Scene::DEFAULT_DIRECTION;
    /// Toward the one light that is there when no light is given.
    pub const DEFAULT_LIGHT: [f64; 3] = Scene::DEFAULT_LIGHT;

    /// Reads a scene from `text`; `path` is what messages call it and what its mesh files are relative to.
    ///
    /// # Errors
    /// [`SceneError`] where the text is not TOML, a key or word is unknown, or a value is of the wrong kind.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<SceneFile, SceneError> {
        // Some editors start a file with a byte-order mark; offsets count without it.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text).to_string();
        let source = Arc::new(SourceText {
            path: path.as_ref().into(),
            text,
        });
        let read: Result<SceneFile, _> = toml::from_str(&source.text);
        match read {
            Ok(mut file) => {
                file.source = Source(Some(source));
                Ok(file)
            }
            Err(error) => Err(SceneError::from_toml(&error, source)),
        }
    }

    /// Reads the scene in the file `path`.
    ///
    /// # Errors
    /// [`SceneError`] when the file cannot be read or is not UTF-8, and those of [`SceneFile::parse`].
    pub fn load(path: impl AsRef<Path>) -> Result<SceneFile, SceneError> {
        let path = path.as_ref();
        let failed = |reason: String, expected: &str| {
            let title = format!("cannot read the scene `{}`: {reason}", path.display());
            SceneError::new(None, Origin::Program, title, expected)
        };
        let bytes = std::fs::read(path).map_err(|error| failed(error.to_string(), ""))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = valid.iter().filter(|byte| **byte == b'\n').count() + 1;
            failed(format!("line {line} is not text"), "expected UTF-8")
        })?;
        SceneFile::parse(&text, path)
    }

    /// The scene that a mesh alone gets: a fitted three-quarter view, one white light, [`Material::default`].
    ///
    /// Every default that matters is spelt out, so that the printed scene shows what there is to change.
    pub fn for_mesh(mesh: impl Into<Located<String>>) -> SceneFile {
        let material = Material::default();
        let (width, height) = Self::DEFAULT_SIZE;
        SceneFile {
            ambient: Some(OneOrThree::splat(1.0).into()),
            image: ImageSection {
                width: Some(i64::from(width).into()),
                height: Some(i64::from(height).into()),
                background: Some(OneOrThree::splat(0.0).into()),
                ..ImageSection::default()
            },
            camera: CameraSection {
                direction: Some(Self::DEFAULT_DIRECTION.into()),
                fit: Some(Self::DEFAULT_FIT.into()),
                ..CameraSection::default()
            },
            material: MaterialSection {
                ka: Some(OneOrThree::shortest(material.ambient).into()),
                kd: Some(OneOrThree::shortest(material.diffuse).into()),
                ks: Some(OneOrThree::shortest(material.specular).into()),
                shininess: Some(shortest(material.shininess).into()),
            },
            light: Some([LightSection::toward(Self::DEFAULT_LIGHT)].into()),
            object: [ObjectSection::new(mesh)].into(),
            ..SceneFile::default()
        }
    }

    /// The scene as TOML, such that [`SceneFile::parse`] gives an equal scene.
    pub fn to_toml(&self) -> String {
        // Tables of numbers, words and text: there is nothing in a scene that TOML could not say.
        toml::to_string(self).expect("a scene is made of tables, numbers and text")
    }

    /// The path of the file that the scene was read from, if it was.
    pub fn path(&self) -> Option<&Path> {
        self.source.0.as_ref().map(|source| source.path.as_path())
    }
}
