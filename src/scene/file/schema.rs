//! The keys of a scene file: one list for reading, for checking, for printing and for command-line flags.
//!
//! Every key is optional but those marked as needed. Angles are in degrees, lengths in world units, colours linear.

use crate::mesh::vertex_normals::NormalSource;
use crate::picture::Encoding;
use crate::scene::{
    Clipping, Culling, DepthSource, Falloff, Interpolation, PainterKey, SpecularGate, SpecularModel,
};
use std::format;
use std::string::String;

/// A key and what may stand on the right of its equals sign.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// The name.
    pub name: &'static str,
    /// The kind of its value.
    pub kind: ValueKind,
    /// True if the table makes no sense without it.
    pub needed: bool,
}

/// A kind of value.
#[derive(Clone, Copy, Debug)]
pub enum ValueKind {
    /// Text in quotes.
    Text,
    /// True or false.
    Switch,
    /// A whole number.
    Whole,
    /// A number.
    Number,
    /// Three numbers: a point or a direction.
    Triple,
    /// Three numbers that may be written as one when they are equal: a colour, a coefficient, a scale.
    OneOrThree,
    /// Three numbers, or an axis by its name.
    Axis,
    /// Three rows of four numbers.
    Matrix,
    /// One of a few words.
    Word(&'static [&'static str]),
    /// A table with these keys.
    Table(&'static [Key]),
    /// Tables with these keys, each under a header of its own.
    Tables(&'static [Key]),
    /// One rotation or a list of them, within the line.
    Turns,
}

impl ValueKind {
    /// Returns the keys of the table, or of each of the tables, that such a value is.
    pub fn keys(self) -> &'static [Key] {
        match self {
            ValueKind::Table(keys) | ValueKind::Tables(keys) => keys,
            ValueKind::Turns => TURN,
            _ => &[],
        }
    }

    /// Returns such a value in words, as an error asks for it.
    pub(super) fn expected(self) -> String {
        match self {
            ValueKind::Text => "text in quotes",
            ValueKind::Switch => "true or false",
            ValueKind::Whole => "a whole number",
            ValueKind::Number => "a number",
            ValueKind::Triple => "three numbers [x, y, z]",
            ValueKind::OneOrThree => "one number or three in brackets",
            ValueKind::Axis => {
                "three numbers [x, y, z] or an axis: \"x\", \"y\", \"z\", \"-x\", \"-y\" or \"-z\""
            }
            ValueKind::Matrix => "three rows of four numbers",
            ValueKind::Word(words) => return format!("\"{}\"", words.join("\" or \"")),
            ValueKind::Table(_) => "a table",
            ValueKind::Tables(_) => "a list of tables",
            ValueKind::Turns => "{ axis = [x, y, z], angle = degrees } or a list of those",
        }
        .into()
    }
}

/// The names of axes, as [`ValueKind::Axis`] takes them.
#[doc(hidden)]
pub const AXES: &[&str] = &["x", "y", "z", "-x", "-y", "-z"];

const fn key(name: &'static str, kind: ValueKind) -> Key {
    let needed = false;
    Key { name, kind, needed }
}

const fn needed(name: &'static str, kind: ValueKind) -> Key {
    let needed = true;
    Key { name, kind, needed }
}

/// An enum whose values are written as words.
pub(super) trait ChoiceWord: Default {
    /// Returns the value that `word` stands for, if it is one of the words.
    fn from_word(word: &str) -> Option<Self>;
}

/// Declares the words of each enum, in the order in which messages and help texts list them.
macro_rules! words {
    ($($name:ident: $type:ty { $($word:literal => $meaning:expr),* })*) => {$(
        const $name: ValueKind = ValueKind::Word(&[$($word),*]);
        impl ChoiceWord for $type {
            fn from_word(word: &str) -> Option<Self> {
                match word {
                    $($word => Some($meaning),)*
                    _ => None,
                }
            }
        }
    )*};
}

words! {
    CLIPPING: Clipping { "planes" => Self::Planes, "ndc-cube" => Self::NdcCube }
    CULLING: Culling { "back" => Self::Back, "front" => Self::Front, "none" => Self::None }
    DEPTH: DepthSource { "interpolated" => Self::Interpolated, "per-sample" => Self::PerSample }
    ENCODING: Encoding { "linear" => Self::Linear, "srgb" => Self::Srgb }
    FALLOFF: Falloff { "none" => Self::None, "inverse-square" => Self::InverseSquare, "inverse" => Self::Inverse }
    GATE: SpecularGate { "gated" => Self::Gated, "ungated" => Self::Ungated, "weighted" => Self::Weighted }
    INTERPOLATION: Interpolation { "screen" => Self::Screen, "perspective" => Self::Perspective }
    NORMALS: NormalSource { "averaged" => Self::Averaged, "auto" => Self::Auto, "given" => Self::Given }
    PAINTER_KEY: PainterKey { "mean" => Self::Mean, "farthest" => Self::Farthest }
    SPECULAR: SpecularModel { "phong" => Self::Phong, "blinn" => Self::Blinn }
}

/// The keys outside of all tables, and the tables.
pub static SCENE: &[Key] = &[
    // A name for captions.
    key("title", ValueKind::Text),
    // For captions: what there is to see.
    key("description", ValueKind::Text),
    // Ambient intensity `I_a`, 0 or more. Default: 1.
    key("ambient", ValueKind::OneOrThree),
    // `screen` is the lecture's and the default.
    key("interpolation", INTERPOLATION),
    // The eye for the highlights: at infinity along the line of sight (the lecture's, default), or where the camera is.
    key("viewer", ValueKind::Word(&["infinite", "local"])),
    // The cosine of the highlights: R·V (the lecture's, default) or N·H.
    key("specular", SPECULAR),
    // The cosine that `shininess` is meant for: where it is not that of `specular`, exponents are converted, four times as
    // large for N·H. Default: that of `specular`.
    key("shininess_for", SPECULAR),
    // Highlights where the light is behind the surface: none (default), as printed, or weighted by L·N.
    key("specular_gate", GATE),
    // The polygons that are left out. Default: `back`.
    key("cull", CULLING),
    // The search for hidden surfaces. Default: `z-buffer`.
    key(
        "visibility",
        ValueKind::Word(&["z-buffer", "painter", "draw-order"]),
    ),
    // Bits of the depth buffer: 16, 24 or 32 (default).
    key("depth_bits", ValueKind::Whole),
    // The source of depth. Default: `interpolated`.
    key("depth", DEPTH),
    // By what the painter sorts. Default: `mean`.
    key("painter_key", PAINTER_KEY),
    // The limits of the view: `planes` (default) or CS171's test of each pixel.
    key("clipping", CLIPPING),
    // True if polygons seen from behind are lit with negated normals. Default: false.
    key("two_sided", ValueKind::Switch),
    key("image", ValueKind::Table(IMAGE)),
    key("camera", ValueKind::Table(CAMERA)),
    // The material of all that has none of its own.
    key("material", ValueKind::Table(MATERIAL)),
    // Default: one white light from the upper right; `light = []` means ambient light only.
    key("light", ValueKind::Tables(LIGHT)),
    // The objects, in the order of drawing; at least one.
    key("object", ValueKind::Tables(OBJECT)),
];

/// `[image]`: size and encoding of the picture.
const IMAGE: &[Key] = &[
    // Pixels a row, 1 to 16,384. Default: 640.
    key("width", ValueKind::Whole),
    // Rows, 1 to 16,384. Default: 480.
    key("height", ValueKind::Whole),
    // Colour where nothing is drawn, 0 to 1. Default: 0.
    key("background", ValueKind::OneOrThree),
    // Alpha of a PNG file: the covered share of each pixel (default), or `opaque` everywhere.
    key("alpha", ValueKind::Word(&["coverage", "opaque"])),
    // The storage of values in eight bits. Default: `linear`.
    key("encoding", ENCODING),
    // Samples a pixel along each side: 1 (default), 2, 4 or 8.
    key("samples", ValueKind::Whole),
];

/// `[camera]`: the place and direction from which the scene is seen.
///
/// With `eye` and without `fit` the camera stands where it is told to. Otherwise it is fitted: it looks at the middle of
/// the bounding box of all objects, from a direction that `direction`, `azimuth` and `elevation`, or `eye` and `target`
/// give, and the objects fill the part `fit` of the frame.
const CAMERA: &[Key] = &[
    // Position of the eye.
    key("eye", ValueKind::Triple),
    // The point in the middle of the picture. Default: the origin.
    key("target", ValueKind::Triple),
    // The direction that is upward in the picture. Default: y, or away from the viewer in a view along y. An axis by its name, as
    // `"z"`, is up in the scene: default view and light, `azimuth` and `elevation` are turned with it. Three numbers are upward in
    // the picture only.
    key("up", ValueKind::Axis),
    // Orthographic: half of the height that is seen. Default: such that the objects fill 0.8 of the frame.
    key("half_height", ValueKind::Number),
    // Perspective: the vertical field of view in degrees, over 0 and under 180.
    key("fovy", ValueKind::Number),
    // Distance of the near plane along the line of sight. Default: before the objects by 5 % of their depth.
    key("near", ValueKind::Number),
    // Distance of the far plane. Default: behind the objects by 5 % of their depth.
    key("far", ValueKind::Number),
    // The part of the frame that the objects fill, 0.001 to 100. Default, without `eye`: 0.8.
    key("fit", ValueKind::Number),
    // From the objects toward the eye. Default: a three-quarter view, (0.5, 0.3, 1).
    key("direction", ValueKind::Triple),
    // Instead of `direction`: degrees around the y axis, from z toward x. Default: 0. Where up is z by its name: around z, from −y
    // toward x.
    key("azimuth", ValueKind::Number),
    // Instead of `direction`: degrees above the horizon, −90 to 90. Default: 0.
    key("elevation", ValueKind::Number),
];

/// `[material]`, or `material` of an object: the coefficients of L21 2.1, 0 or more.
const MATERIAL: &[Key] = &[
    key("ka", ValueKind::OneOrThree),
    key("kd", ValueKind::OneOrThree),
    key("ks", ValueKind::OneOrThree),
    // The exponent `n`.
    key("shininess", ValueKind::Number),
];

/// `[[light]]`: a light at infinity (`direction`) or at a place (`position`).
const LIGHT: &[Key] = &[
    // Toward the light, in world space; any length but 0.
    key("direction", ValueKind::Triple),
    // Instead of `direction`: where the light is, in world space; not at a vertex.
    key("position", ValueKind::Triple),
    // Intensity of each channel, 0 or more. Default: 1.
    key("colour", ValueKind::OneOrThree),
    // A factor on the colour, 0 or more. Default: 1.
    key("intensity", ValueKind::Number),
    // With `position`: k of the attenuation 1 / (1 + k d²), 0 or more (CS171 2). Default: none.
    key("attenuation", ValueKind::Number),
    // Instead of `attenuation`: 1/r² or 1/r (L5). Default: `none`.
    key("falloff", FALLOFF),
];

/// `[[object]]`: a mesh somewhere in the world. It is scaled, then rotated, then translated.
const OBJECT: &[Key] = &[
    // An OBJ file (relative to the scene file), or `builtin:NAME`, or `builtin:NAME?key=value&key=value`.
    needed("mesh", ValueKind::Text),
    // Vertex normals: averaged within smoothing groups (default: L21 3.1), those of the mesh where it has some (`auto`), or
    // those and else averages regardless of smoothing groups (`given`). Of a mesh file on its own: `auto`.
    key("normals", NORMALS),
    // Instead of `normals`: average over polygons whose normals differ by at most so many degrees, 0 to 180.
    key("crease", ValueKind::Number),
    // Positions nearer than this part of the mesh's size are one, 1e-12 to 0.1. Default: only equal ones are.
    key("weld", ValueKind::Number),
    // Factors, none of them 0; a negative one mirrors.
    key("scale", ValueKind::OneOrThree),
    // A rotation, or a list of them, of which the first is done first.
    key("rotate", ValueKind::Turns),
    // The place of the mesh's origin.
    key("translate", ValueKind::Triple),
    // Instead of the three above: three rows of four numbers, the last of each being the translation.
    key("matrix", ValueKind::Matrix),
    // Replaces the materials of the mesh; keys that are absent here are those of `[material]`.
    key("material", ValueKind::Table(MATERIAL)),
];

/// One rotation, counter-clockwise for who looks against the axis.
const TURN: &[Key] = &[
    // The axis through the origin; any length but 0.
    needed("axis", ValueKind::Triple),
    // The angle in degrees.
    needed("angle", ValueKind::Number),
];

/// Returns the kind of the value at `path`, such as `camera.fovy`, if there is such a key.
pub fn kind(path: &str) -> Option<ValueKind> {
    let find = |keys: &'static [Key], name: &str| keys.iter().find(|key| key.name == name);
    match path.split_once('.') {
        None => find(SCENE, path).map(|key| key.kind),
        Some((table, name)) => find(find(SCENE, table)?.kind.keys(), name).map(|key| key.kind),
    }
}
