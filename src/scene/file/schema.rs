//! The keys of a scene file: one list for reading, for checking, for printing and for command-line flags.
//!
//! Every key is optional but those marked as needed. Angles are in degrees, lengths in world units, colours linear.

use ValueKind::{
    Axis, Matrix, Number, OneOrThree, Switch, Table, Tables, Text, Triple, Turns, Whole, Word,
};

use crate::mesh::vertex_normals::{NormalSource, NormalWeight};
use crate::picture::Encoding;
use crate::scene::{
    Clipping, Culling, DepthSource, Falloff, Interpolation, PainterKey, SpecularGate, SpecularModel,
};
use std::format;
use std::string::String;

/// A key and what may stand on the right of its equals sign.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// The name of its table and its own, as in `camera.eye`; only the name for keys outside of all tables.
    pub path: &'static str,
    /// The kind of its value.
    pub kind: ValueKind,
    /// True if the table makes no sense without it.
    pub needed: bool,
    /// The command-line flag for it, if there is one.
    pub flag: Option<Flag>,
}

/// A command-line flag that gives a value to a key.
#[derive(Clone, Copy, Debug)]
pub struct Flag {
    /// The name, without hyphens before it.
    pub name: &'static str,
    /// The word for its value in help texts; empty for a switch.
    pub value_name: &'static str,
    /// Its meaning, as `--help` says it.
    pub meaning: &'static str,
    /// The default in `docs/flags.md`; empty if the meaning says it.
    pub default: &'static str,
    /// What follows `render` for the pictures in `docs/flags.md`, without the flag and with it.
    pub pictures: [&'static str; 2],
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
    /// A table with the keys of this name.
    Table(&'static str),
    /// Tables with the keys of this name, each under its own header.
    Tables(&'static str),
    /// One rotation or a list of them, within the line.
    Turns,
}

impl ValueKind {
    /// Returns the keys of the table, or of each of the tables, that such a value is: tables come last, as TOML wants it.
    pub fn keys(self) -> impl Iterator<Item = &'static Key> {
        let table = match self {
            Table(name) | Tables(name) => Some(name),
            Turns => Some("turn"),
            _ => None,
        };
        let all = KEYS.iter().filter(move |key| Some(key.split().0) == table);
        let is_table = |key: &&Key| matches!(key.kind, Table(_) | Tables(_));
        let values = all.clone().filter(move |key| !is_table(key));
        values.chain(all.filter(is_table))
    }

    /// Returns such a value in words, as an error asks for it.
    pub(super) fn expected(self) -> String {
        match self {
            Text => "text in quotes",
            Switch => "true or false",
            Whole => "a whole number",
            Number => "a number",
            Triple => "three numbers [x, y, z]",
            OneOrThree => "one number or three in brackets",
            Axis => {
                "three numbers [x, y, z] or an axis: \"x\", \"y\", \"z\", \"-x\", \"-y\" or \"-z\""
            }
            Matrix => "three rows of four numbers",
            Word(words) => return format!("\"{}\"", words.join("\" or \"")),
            Table(_) => "a table",
            Tables(_) => "a list of tables",
            Turns => "{ axis = [x, y, z], angle = degrees } or a list of those",
        }
        .into()
    }
}

/// The names of axes, as [`ValueKind::Axis`] takes them.
#[doc(hidden)]
pub const AXES: &[&str] = &["x", "y", "z", "-x", "-y", "-z"];

const fn key(path: &'static str, kind: ValueKind) -> Key {
    Key {
        path,
        kind,
        needed: false,
        flag: None,
    }
}

impl Key {
    const fn needed(mut self) -> Key {
        self.needed = true;
        self
    }

    const fn flag(
        mut self,
        name: &'static str,
        value_name: &'static str,
        meaning: &'static str,
        default: &'static str,
        pictures: [&'static str; 2],
    ) -> Key {
        self.flag = Some(Flag {
            name,
            value_name,
            meaning,
            default,
            pictures,
        });
        self
    }

    /// Returns the name of its table, empty outside of all tables, and its own.
    fn split(&self) -> (&'static str, &'static str) {
        self.path.split_once('.').unwrap_or(("", self.path))
    }

    /// Returns its name within the table.
    pub fn name(&self) -> &'static str {
        self.split().1
    }
}

/// An enum whose values are written as words.
pub(super) trait ChoiceWord: Default {
    /// Returns the value that `word` stands for, if it is one of the words.
    fn from_word(word: &str) -> Option<Self>;
}

/// Declares the words of each enum, in the order in which messages and help texts list them.
macro_rules! words {
    ($($name:ident: $type:ty { $($word:literal => $meaning:expr),* })*) => {$(
        const $name: ValueKind = Word(&[$($word),*]);
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
    NORMALS_WEIGHT: NormalWeight { "uniform" => Self::Uniform, "area" => Self::Area, "angle" => Self::Angle, "max" => Self::Max }
    PAINTER_KEY: PainterKey { "mean" => Self::Mean, "farthest" => Self::Farthest }
    SPECULAR: SpecularModel { "phong" => Self::Phong, "blinn" => Self::Blinn }
}

/// The scene itself: a table of the keys outside of all tables.
pub const SCENE: ValueKind = ValueKind::Table("");

/// All keys, in the order in which flags are listed and the values of a table are written. `scenes/README.md` has ranges and
/// defaults.
#[rustfmt::skip]
pub static KEYS: &[Key] = &[
    // A name for captions, and what there is to see.
    key("title", Text),
    key("description", Text),
    key("image", Table("image")),
    // With `eye` and without `fit` the camera stands where it is told to. Otherwise it is fitted: it looks at the middle of the bounding
    // box of all objects, from a direction that `direction`, `azimuth` and `elevation`, or `eye` and `target` give.
    key("camera", Table("camera")),
    // The material of everything without its own.
    key("material", Table("material")),
    key("image.width", Whole).flag("resolution", "WIDTHxHEIGHT",
        "Size of the picture, 1x1 to 16384x16384 [default: the scene's, else 640x480]",
        "", ["teapot --resolution 160x120", "teapot --resolution 40x30"]),
    key("image.height", Whole),
    // Degrees around the y axis, from z toward x. Where up is z by its name: around z, from −y toward x.
    key("camera.azimuth", Number).flag("view", "AZIMUTH,ELEVATION",
        "See the scene from this direction, in degrees: 0,0 is from +z, azimuth turns toward +x, elevation toward +y (up)",
        "the camera of the scene", ["teapot", "teapot --view 200,50"]),
    key("camera.elevation", Number),
    key("camera.eye", Triple).flag("eye", "X,Y,Z", "Put the eye here", "fitted", ["builtin:cube", "builtin:cube --eye 0,1,3"]),
    key("camera.target", Triple).flag("target", "X,Y,Z", "Look at this point [default, with --eye: the origin]",
        "the origin", ["builtin:cube --eye 2,2,3", "builtin:cube --eye 2,2,3 --target 1,0,0"]),
    // The pictures: three numbers and an axis by its name, side by side.
    key("camera.up", Axis).flag("up", "AXIS|X,Y,Z",
        "Direction that is up: an axis by its name, as `z` or `-y`, turns the default view, --view and the default light with it; \
         three numbers, as `0,0,1`, turn the picture only [default: y]",
        "", ["builtin:teapot --resolution 80x60 --up 0,0,1", "builtin:teapot --resolution 80x60 --up z"]),
    key("camera.fovy", Number).flag("fovy", "DEGREES", "Perspective projection with this vertical field of view",
        "orthographic", ["corrugated", "corrugated --fovy 70"]),
    key("camera.half_height", Number).flag("half-height", "LENGTH",
        "Orthographic projection; half of the visible height, in world units",
        "fitted", ["vase", "vase --half-height 4"]),
    key("camera.near", Number).flag("near", "DISTANCE", "Distance of the near plane",
        "fitted", ["terrain --eye 0,2,4", "terrain --eye 0,2,4 --near 4"]),
    key("camera.far", Number).flag("far", "DISTANCE", "Distance of the far plane",
        "fitted", ["terrain --eye 0,2,4", "terrain --eye 0,2,4 --far 4"]),
    key("camera.fit", Number).flag("fit", "FRACTION",
        "Fit the camera: objects fill this fraction of the picture, 0.001 to 100; over 1 they reach beyond it",
        "0.8", ["football", "football --fit 0.4"]),
    // From the objects toward the eye, instead of `azimuth` and `elevation`.
    key("camera.direction", Triple),
    key("light.direction", Triple).flag("light", "X,Y,Z[,I|,R,G,B]",
        "A light from this direction, instead of those of the scene; can be given several times",
        "those of the scene", ["vase", "vase --light=-1,0.5,0.2"]),
    key("light.position", Triple).flag("light-at", "X,Y,Z[,I|,R,G,B]",
        "A light at this position, instead of those of the scene; can be given several times",
        "those of the scene", ["terrain --light 0,1,0", "terrain --light-at 0,0.5,0"]),
    key("light.colour", OneOrThree),
    // A factor on the colour.
    key("light.intensity", Number),
    key("light.attenuation", Number).flag("attenuation", "K", "Attenuation 1 / (1 + k d²) of the lights given by --light-at",
        "none", ["terrain --light-at 1,1,1", "terrain --light-at 1,1,1 --attenuation 1"]),
    key("light.falloff", FALLOFF).flag("falloff", "LAW",
        "Falloff of the lights given by --light-at, in place of attenuation: 1 / r² or 1 / r",
        "none", ["terrain --light-at 1,1,1", "terrain --light-at 1,1,1 --falloff inverse-square"]),
    key("light", Tables("light")).flag("no-lights", "", "No lights: ambient light only",
        "off", ["vase --ambient 3", "vase --ambient 3 --no-lights"]),
    // The objects, in the order of drawing; at least one. They are scaled, then rotated, then translated.
    key("object", Tables("object")),
    key("ambient", OneOrThree).flag("ambient", "I|R,G,B", "Ambient intensity", "1", ["vase", "vase --ambient 3"]),
    // The coefficients of L21 2.1.
    key("material.ka", OneOrThree).flag("ka", "K|R,G,B",
        "Ambient reflection of all objects, in place of the materials of a mesh file",
        "0.08,0.07,0.06", ["teapot", "teapot --ka 0.3"]),
    key("material.kd", OneOrThree).flag("kd", "K|R,G,B",
        "Diffuse reflection of all objects, in place of the materials of a mesh file",
        "0.6,0.45,0.3", ["teapot", "teapot --kd 0.1,0.3,0.6"]),
    key("material.ks", OneOrThree).flag("ks", "K|R,G,B",
        "Specular reflection of all objects, in place of the materials of a mesh file",
        "0.4", ["fine-sphere", "fine-sphere --ks 0"]),
    key("material.shininess", Number).flag("shininess", "N",
        "Exponent of the highlights of all objects, in place of the materials of a mesh file",
        "32", ["fine-sphere", "fine-sphere --shininess 4"]),
    key("image.background", OneOrThree).flag("background", "C|R,G,B", "Colour where nothing is drawn",
        "0", ["teapot", "teapot --background 0.2,0.3,0.5"]),
    key("interpolation", INTERPOLATION).flag("interpolation", "SPACE",
        "Interpolation of varyings: linear on the screen, as in the lecture, or in space (perspective-correct)",
        "screen", ["perspective --aov checkerboard --interpolation screen", "perspective --aov checkerboard --interpolation perspective"]),
    key("viewer", Word(&["infinite", "local"])).flag("viewer", "WHERE",
        "Position of the eye for highlights: at infinity, as in the lecture, or at the camera",
        "infinite", ["local-lights --viewer infinite", "local-lights --viewer local"]),
    key("specular", SPECULAR).flag("specular", "MODEL", "Cosine of the highlights: phong (R.V) or blinn (N.H)",
        "phong", ["fine-sphere --light 1,0.3,-0.5", "fine-sphere --light 1,0.3,-0.5 --specular blinn"]),
    key("shininess_for", SPECULAR).flag("shininess-for", "MODEL",
        "Model that shininess values were chosen for; they are converted if --specular differs",
        "that of --specular", ["fine-sphere --specular blinn", "fine-sphere --specular blinn --shininess-for phong"]),
    key("specular_gate", GATE).flag("specular-gate", "GATE",
        "Highlights where the light is behind the surface: gated (none), ungated (as the lecture's formula gives) or weighted (times L.N)",
        "gated", ["fine-sphere --light 1,0.3,-0.8 --shininess 4 --specular blinn",
                  "fine-sphere --light 1,0.3,-0.8 --shininess 4 --specular blinn --specular-gate ungated"]),
    key("colours", Word(&["off", "on"])).flag("colours", "off|on",
        "Light the vertex colours of mesh files: the ambient and the diffuse reflection are multiplied by them \
         [default: the scene's, else on for a mesh file]",
        "", ["builtin:terrain?colours=true --resolution 80x60 --view 30,30 --colours off", "builtin:terrain?colours=true --resolution 80x60 --view 30,30"]),
    key("image.alpha", Word(&["coverage", "opaque"])).flag("alpha", "ALPHA",
        "Alpha of a PNG file: the covered share of each pixel, or opaque everywhere",
        "coverage", ["fine-sphere", "fine-sphere --alpha opaque"]),
    key("image.encoding", ENCODING).flag("encoding", "NAME", "Encoding of stored pictures in 8 bits",
        "linear", ["football", "football --encoding srgb"]),
    key("cull", CULLING).flag("cull", "SIDE",
        "Cull polygons seen from this side [default: the scene's, else back; none for a mesh file whose winding tells no outside]",
        "", ["builtin:sphere --eye 0,2,3 --near 3 --ambient 3", "builtin:sphere --eye 0,2,3 --near 3 --ambient 3 --cull none"]),
    key("visibility", Word(&["z-buffer", "painter", "draw-order"])).flag("visibility", "METHOD",
        "Hidden surfaces: a depth buffer, the painter's algorithm (sorted from back to front), or the order of drawing",
        "z-buffer", ["interpenetration", "interpenetration --visibility painter"]),
    key("depth_bits", Whole).flag("depth-bits", "BITS", "Bits of the depth buffer: 16, 24 or 32",
        "32", ["z-fighting --depth-bits 32", "z-fighting --depth-bits 16"]),
    key("depth", DEPTH).flag("depth", "SOURCE",
        "Depth: interpolated between corners, or computed from the distance at each sample",
        "interpolated", ["z-fighting --samples 4", "z-fighting --samples 4 --depth per-sample"]),
    key("painter_key", PAINTER_KEY).flag("painter-key", "KEY",
        "Sorting key of the painter's algorithm: the mean depth of the corners, or that of the farthest one",
        "mean", ["interpenetration --visibility painter", "interpenetration --visibility painter --painter-key farthest"]),
    key("clipping", CLIPPING).flag("clipping", "METHOD", "Clipping: by planes, or by CS171's test of each pixel",
        "planes", ["terrain --eye 0,0.15,0.3 --fovy 80", "terrain --eye 0,0.15,0.3 --fovy 80 --clipping ndc-cube"]),
    key("two_sided", Switch).flag("two-sided", "",
        "Light polygons seen from behind with negated normals (with `--cull none`) \
         [default: the scene's, else off; on for a mesh file whose winding tells no outside]",
        "", ["terrain --view 30,-30 --cull none", "terrain --view 30,-30 --cull none --two-sided"]),
    key("image.samples", Whole).flag("samples", "N",
        "Supersampling: samples along each side of a pixel, 1, 2, 4 or 8, each with its own depth and colour",
        "1", ["football", "football --samples 4"]),
    // An OBJ file (relative to the scene file), or `builtin:NAME`, or `builtin:NAME?key=value&key=value`.
    key("object.mesh", Text).needed(),
    key("object.normals", NORMALS).flag("normals", "SOURCE",
        "Vertex normals: `auto`, as the mesh states them by normals and smoothing groups; `averaged` within smoothing groups; \
         `given` with the mesh; or averaged up to an angle, `crease=30` \
         [default: the scene's, else `auto` for a mesh file and `averaged` for a built-in mesh]",
        "", ["football", "football --normals crease=10"]),
    key("object.normals_weight", NORMALS_WEIGHT).flag("normals-weight", "WEIGHT",
        "Weight of polygons where vertex normals are averaged: `uniform`, all alike, as in the lecture; `area` of the polygon; its `angle` at \
         the vertex; or `max`, Max's weights, exact on spheres [default: the scene's, else `angle` for a mesh file and `uniform` for a \
         built-in mesh]",
        "", ["vase --resolution 80x60", "vase --resolution 80x60 --normals-weight area"]),
    key("object.crease", Number),
    key("object.weld", Number).flag("weld", "PART",
        "Take positions that are nearer than this part of the mesh's size for one, so that normals are averaged over them, 1e-12 to 0.1 \
         [default: only equal positions are one]",
        "", ["vase --resolution 80x60", "vase --resolution 80x60 --weld 0.1"]),
    key("object.scale", OneOrThree),
    // One rotation, or a list of them, of which the first is done first.
    key("object.rotate", Turns),
    key("object.translate", Triple),
    // Instead of the three above: three rows of four numbers, the last of each being the translation.
    key("object.matrix", Matrix),
    // Replaces the materials of the mesh; keys that are absent here are those of `[material]`.
    key("object.material", Table("material")),
    // Counter-clockwise for who looks against the axis, in degrees.
    key("turn.axis", Triple).needed(),
    key("turn.angle", Number).needed(),
];

/// Returns the kind of the value at `path`, such as `camera.fovy`, if there is such a key.
pub fn kind(path: &str) -> Option<ValueKind> {
    let found = KEYS.iter().find(|key| key.path == path);
    found.map(|key| key.kind)
}
