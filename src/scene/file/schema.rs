//! The keys of a scene file: one list for reading, checking, printing and command-line flags.
//!
//! Every key is optional unless it is marked as needed. Angles are in degrees, lengths in world
//! units, and colours are linear.

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

/// A key and the kind of its value.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// The table and the name, as in `camera.eye`. Keys outside all tables have only a name.
    pub path: &'static str,
    /// The kind of its value.
    pub kind: ValueKind,
    /// True if the table is invalid without it.
    pub needed: bool,
    /// The command-line flag that sets it, if there is one.
    pub flag: Option<Flag>,
}

/// A command-line flag that sets a key.
#[derive(Clone, Copy, Debug)]
pub struct Flag {
    /// The name, without leading hyphens.
    pub name: &'static str,
    /// The word for its value in help texts. Empty for a switch.
    pub value_name: &'static str,
    /// What it does, as `--help` says it.
    pub meaning: &'static str,
    /// The default in `docs/flags.md`. Empty if the meaning states it.
    pub default: &'static str,
    /// The arguments of `render` for the pictures in `docs/flags.md`, without the flag and with it.
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
    /// Three numbers, or one number for all three: a colour, a coefficient, a scale.
    OneOrThree,
    /// Three numbers, or the name of an axis.
    Axis,
    /// Three rows of four numbers.
    Matrix,
    /// One of a few words.
    Word(&'static [&'static str]),
    /// A table with the keys of this name.
    Table(&'static str),
    /// Tables with the keys of this name, each under its own header.
    Tables(&'static str),
    /// One rotation or a list of rotations, written inline.
    Turns,
}

impl ValueKind {
    /// Returns the keys of the table, or of each of the tables. Tables come last, because TOML
    /// requires it.
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

    /// Describes the kind in the words of an error.
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

/// The names of axes that [`ValueKind::Axis`] accepts.
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

    /// Returns the name of the table, empty for keys outside all tables, and the name of the key.
    fn split(&self) -> (&'static str, &'static str) {
        self.path.split_once('.').unwrap_or(("", self.path))
    }

    /// Returns the name within the table.
    pub fn name(&self) -> &'static str {
        self.split().1
    }
}

/// An enum whose values are written as words.
pub(super) trait ChoiceWord: Default {
    /// Returns the value for `word`, if it is one of the words.
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

/// The scene itself: a table of the keys outside all tables.
pub const SCENE: ValueKind = ValueKind::Table("");

/// All keys, in the order in which flags are listed and tables are written. `scenes/README.md` has
/// ranges and defaults.
#[rustfmt::skip]
pub static KEYS: &[Key] = &[
    // A name for captions, and what the scene shows.
    key("title", Text),
    key("description", Text),
    key("image", Table("image")),
    // With `eye` and without `fit` the camera stands at `eye`. Otherwise it is fitted: it looks at
    // the middle of the bounding box of all objects. Its direction comes from `direction`, from
    // `azimuth` and `elevation`, or from `eye` and `target`.
    key("camera", Table("camera")),
    // The material of everything that has none.
    key("material", Table("material")),
    key("image.width", Whole).flag("resolution", "WIDTHxHEIGHT",
        "Size of the picture, 1x1 to 16384x16384 [default: the scene's, else 640x480]",
        "", ["teapot --resolution 160x120", "teapot --resolution 40x30"]),
    key("image.height", Whole),
    // Degrees around the y axis, from z toward x. If the up axis is z by name: around z, from −y
    // toward x.
    key("camera.azimuth", Number).flag("view", "AZIMUTH,ELEVATION",
        "Direction of view, in degrees: 0,0 looks from +z; azimuth turns toward +x, elevation toward +y (up)",
        "the camera of the scene", ["teapot", "teapot --view 200,50"]),
    key("camera.elevation", Number),
    key("camera.eye", Triple).flag("eye", "X,Y,Z", "Position of the eye", "fitted", ["builtin:cube", "builtin:cube --eye 0,1,3"]),
    key("camera.target", Triple).flag("target", "X,Y,Z", "Look at this point [default, with --eye: the origin]",
        "the origin", ["builtin:cube --eye 2,2,3", "builtin:cube --eye 2,2,3 --target 1,0,0"]),
    // The pictures compare three numbers with the name of an axis.
    key("camera.up", Axis).flag("up", "AXIS|X,Y,Z",
        "Direction that is up: the name of an axis, such as `z` or `-y`, also turns the default view, --view and the default light; \
         three numbers, such as `0,0,1`, turn only the picture [default: y]",
        "", ["builtin:teapot --resolution 80x60 --up 0,0,1", "builtin:teapot --resolution 80x60 --up z"]),
    key("camera.fovy", Number).flag("fovy", "DEGREES", "Perspective projection with this vertical field of view",
        "orthographic", ["corrugated", "corrugated --fovy 70"]),
    key("camera.half_height", Number).flag("half-height", "LENGTH",
        "Orthographic projection that shows twice this height, in world units",
        "fitted", ["vase", "vase --half-height 4"]),
    key("camera.near", Number).flag("near", "DISTANCE", "Distance of the near plane",
        "fitted", ["terrain --eye 0,2,4", "terrain --eye 0,2,4 --near 4"]),
    key("camera.far", Number).flag("far", "DISTANCE", "Distance of the far plane",
        "fitted", ["terrain --eye 0,2,4", "terrain --eye 0,2,4 --far 4"]),
    key("camera.fit", Number).flag("fit", "FRACTION",
        "Fit the camera so that the objects fill this fraction of the picture, 0.001 to 100; above 1 they extend beyond it",
        "0.8", ["football", "football --fit 0.4"]),
    // From the objects toward the eye. Excludes `azimuth` and `elevation`.
    key("camera.direction", Triple),
    key("light.direction", Triple).flag("light", "X,Y,Z[,I|,R,G,B]",
        "Light from this direction, instead of the scene's lights; can be repeated",
        "the scene's lights", ["vase", "vase --light=-1,0.5,0.2"]),
    key("light.position", Triple).flag("light-at", "X,Y,Z[,I|,R,G,B]",
        "Light at this position, instead of the scene's lights; can be repeated",
        "the scene's lights", ["terrain --light 0,1,0", "terrain --light-at 0,0.5,0"]),
    key("light.colour", OneOrThree),
    // A factor on the colour.
    key("light.intensity", Number),
    key("light.attenuation", Number).flag("attenuation", "K", "Attenuate the lights of --light-at by 1 / (1 + k d²)",
        "none", ["terrain --light-at 1,1,1", "terrain --light-at 1,1,1 --attenuation 1"]),
    key("light.falloff", FALLOFF).flag("falloff", "LAW",
        "Falloff of the lights of --light-at, instead of --attenuation: 1 / r² or 1 / r",
        "none", ["terrain --light-at 1,1,1", "terrain --light-at 1,1,1 --falloff inverse-square"]),
    key("light", Tables("light")).flag("no-lights", "", "Remove all lights, so that only ambient light is left",
        "off", ["vase --ambient 3", "vase --ambient 3 --no-lights"]),
    // The objects in drawing order, at least one. Each is scaled, then rotated, then translated.
    key("object", Tables("object")),
    key("ambient", OneOrThree).flag("ambient", "I|R,G,B", "Intensity of the ambient light", "1", ["vase", "vase --ambient 3"]),
    // The coefficients of L21 2.1.
    key("material.ka", OneOrThree).flag("ka", "K|R,G,B",
        "Ambient reflection of all objects, instead of the materials of a mesh file",
        "0.08,0.07,0.06", ["teapot", "teapot --ka 0.3"]),
    key("material.kd", OneOrThree).flag("kd", "K|R,G,B",
        "Diffuse reflection of all objects, instead of the materials of a mesh file",
        "0.6,0.45,0.3", ["teapot", "teapot --kd 0.1,0.3,0.6"]),
    key("material.ks", OneOrThree).flag("ks", "K|R,G,B",
        "Specular reflection of all objects, instead of the materials of a mesh file",
        "0.4", ["fine-sphere", "fine-sphere --ks 0"]),
    key("material.shininess", Number).flag("shininess", "N",
        "Exponent of the highlights of all objects, instead of the materials of a mesh file",
        "32", ["fine-sphere", "fine-sphere --shininess 4"]),
    key("image.background", OneOrThree).flag("background", "C|R,G,B", "Colour where nothing is drawn",
        "0", ["teapot", "teapot --background 0.2,0.3,0.5"]),
    key("interpolation", INTERPOLATION).flag("interpolation", "SPACE",
        "Interpolate varyings linearly on the screen, as in the lecture, or in space (perspective-correct)",
        "screen", ["perspective --aov checkerboard --interpolation screen", "perspective --aov checkerboard --interpolation perspective"]),
    key("viewer", Word(&["infinite", "local"])).flag("viewer", "WHERE",
        "Where the eye is for highlights: at infinity, as in the lecture, or at the camera",
        "infinite", ["local-lights --viewer infinite", "local-lights --viewer local"]),
    key("specular", SPECULAR).flag("specular", "MODEL", "Model of the highlights: phong (R.V) or blinn (N.H)",
        "phong", ["fine-sphere --light 1,0.3,-0.5", "fine-sphere --light 1,0.3,-0.5 --specular blinn"]),
    key("shininess_for", SPECULAR).flag("shininess-for", "MODEL",
        "Model that the shininess values were chosen for; they are converted if --specular differs",
        "the model of --specular", ["fine-sphere --specular blinn", "fine-sphere --specular blinn --shininess-for phong"]),
    key("specular_gate", GATE).flag("specular-gate", "GATE",
        "Highlights where the light is behind the surface: gated (none), ungated (as in the lecture's formula) or weighted (times L.N)",
        "gated", ["fine-sphere --light 1,0.3,-0.8 --shininess 4 --specular blinn",
                  "fine-sphere --light 1,0.3,-0.8 --shininess 4 --specular blinn --specular-gate ungated"]),
    key("colours", Word(&["off", "on"])).flag("colours", "off|on",
        "Multiply the ambient and the diffuse reflection by the vertex colours of mesh files \
         [default: the scene's, else on for a mesh file]",
        "", ["builtin:terrain?colours=true --resolution 80x60 --view 30,30 --colours off", "builtin:terrain?colours=true --resolution 80x60 --view 30,30"]),
    key("image.alpha", Word(&["coverage", "opaque"])).flag("alpha", "ALPHA",
        "Alpha of a PNG file: the covered share of each pixel, or opaque everywhere",
        "coverage", ["fine-sphere", "fine-sphere --alpha opaque"]),
    key("image.encoding", ENCODING).flag("encoding", "NAME", "Encoding of 8-bit pictures",
        "linear", ["football", "football --encoding srgb"]),
    key("cull", CULLING).flag("cull", "SIDE",
        "Cull polygons seen from this side [default: the scene's, else back; none for a mesh file whose winding does not show which side is outside]",
        "", ["builtin:sphere --eye 0,2,3 --near 3 --ambient 3", "builtin:sphere --eye 0,2,3 --near 3 --ambient 3 --cull none"]),
    key("visibility", Word(&["z-buffer", "painter", "draw-order"])).flag("visibility", "METHOD",
        "Method for hidden surfaces: a depth buffer, the painter's algorithm (sorts from back to front), or the order of drawing",
        "z-buffer", ["interpenetration", "interpenetration --visibility painter"]),
    key("depth_bits", Whole).flag("depth-bits", "BITS", "Bits of the depth buffer: 16, 24 or 32",
        "32", ["z-fighting --depth-bits 32", "z-fighting --depth-bits 16"]),
    key("depth", DEPTH).flag("depth", "SOURCE",
        "Source of the depth: interpolated between corners, or computed from the distance at each sample",
        "interpolated", ["z-fighting --samples 4", "z-fighting --samples 4 --depth per-sample"]),
    key("painter_key", PAINTER_KEY).flag("painter-key", "KEY",
        "Sorting key of the painter's algorithm: the mean depth of the corners, or the depth of the farthest one",
        "mean", ["interpenetration --visibility painter", "interpenetration --visibility painter --painter-key farthest"]),
    key("clipping", CLIPPING).flag("clipping", "METHOD", "Clip by planes, or by CS171's test at each pixel",
        "planes", ["terrain --eye 0,0.15,0.3 --fovy 80", "terrain --eye 0,0.15,0.3 --fovy 80 --clipping ndc-cube"]),
    key("two_sided", Switch).flag("two-sided", "",
        "Light polygons seen from behind with negated normals (with `--cull none`) \
         [default: the scene's, else off; on for a mesh file whose winding does not show which side is outside]",
        "", ["terrain --view 30,-30 --cull none", "terrain --view 30,-30 --cull none --two-sided"]),
    key("image.samples", Whole).flag("samples", "N",
        "Supersampling: samples along each side of a pixel, 1, 2, 4 or 8, each with its own depth and colour",
        "1", ["football", "football --samples 4"]),
    // A mesh file (relative to the scene file), `builtin:NAME`, or
    // `builtin:NAME?key=value&key=value`.
    key("object.mesh", Text).needed(),
    key("object.normals", NORMALS).flag("normals", "SOURCE",
        "Vertex normals: `auto` follows the normals and smoothing groups of the mesh; `averaged` averages within smoothing groups; \
         `given` uses the normals of the mesh; `crease=30` averages across angles of up to 30 degrees \
         [default: the scene's, else `auto` for a mesh file and `averaged` for a built-in mesh]",
        "", ["football", "football --normals crease=10"]),
    key("object.normals_weight", NORMALS_WEIGHT).flag("normals-weight", "WEIGHT",
        "Weight of each polygon in an averaged normal: `uniform`, all equal, as in the lecture; `area`, the polygon's area; `angle`, its angle at \
         the vertex; or `max`, Max's weights, which are exact on spheres [default: the scene's, else `angle` for a mesh file and `uniform` for a \
         built-in mesh]",
        "", ["vase --resolution 80x60", "vase --resolution 80x60 --normals-weight area"]),
    key("object.crease", Number),
    key("object.weld", Number).flag("weld", "FRACTION",
        "Merge positions that are closer than this fraction of the mesh's size, 1e-12 to 0.1, so that normals are averaged across them \
         [default: merge equal positions only]",
        "", ["vase --resolution 80x60", "vase --resolution 80x60 --weld 0.1"]),
    key("object.scale", OneOrThree),
    // One rotation, or a list of rotations. The first one in the list is applied first.
    key("object.rotate", Turns),
    key("object.translate", Triple),
    // Excludes the three above. Three rows of four numbers, the last number of each being the
    // translation.
    key("object.matrix", Matrix),
    // Replaces the materials of the mesh. Absent keys come from `[material]`.
    key("object.material", Table("material")),
    // In degrees, counter-clockwise when seen against the axis.
    key("turn.axis", Triple).needed(),
    key("turn.angle", Number).needed(),
];

/// Returns the kind of the value at `path`, such as `camera.fovy`, or `None` if there is no such
/// key.
pub fn kind(path: &str) -> Option<ValueKind> {
    let found = KEYS.iter().find(|key| key.path == path);
    found.map(|key| key.kind)
}
