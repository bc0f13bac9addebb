//! The numbers of a scene: matrices, lights, materials and rules, in the order of the files.

use super::formats::{Entry, Kind, Table, Value, word};
use super::mesh::{Mesh, NamedMaterial};
use super::terms::{exponent, unit};
use alloc::string::String;
use alloc::vec::Vec;
use fastphong::picture::{Encoding, Rgb};
use fastphong::scene::{
    Clipping, Culling, DepthSource, Falloff, HiddenSurfaces, Interpolation, Light, PainterKey,
    Place, Projection, Scene, SpecularGate, SpecularModel,
};
use glam::{DMat4, DVec3, DVec4};

/// Infinity as the distance of the far plane stands for this.
const FARTHEST: f64 = 1e20;

/// The columns of the table of materials.
const MATERIAL: &[(&str, Kind)] = &[
    ("name", Kind::Text),
    ("ka", Kind::Vector),
    ("kd", Kind::Vector),
    ("ks", Kind::Vector),
    ("n", Kind::Number),
];

/// The columns of the table of lights.
const LIGHT: &[(&str, Kind)] = &[
    ("positional", Kind::Flag),
    ("direction", Kind::Vector),
    ("direction_view", Kind::Vector),
    ("position", Kind::Vector),
    ("position_view", Kind::Vector),
    ("colour", Kind::Vector),
    ("falloff", Kind::Text),
    ("attenuation", Kind::Number),
];

/// Returns the matrix from world space to view space: the eye at the origin, x to the right, y
/// upward, and the line of sight along -z.
pub fn view(scene: &Scene) -> DMat4 {
    let [right, up, forward] = scene.camera.axes();
    let row = |axis: DVec3| axis.extend(-axis.dot(scene.camera.eye));
    DMat4::from_cols(row(right), row(up), row(-forward), DVec4::W).transpose()
}

/// Returns the matrix from view space to clip space, with OpenGL's z from -w to w.
fn projection(scene: &Scene) -> DMat4 {
    let camera = &scene.camera;
    let aspect = f64::from(scene.width) / f64::from(scene.height);
    let (near, far) = (camera.near, camera.far.min(FARTHEST));
    let depth = far - near;
    let rows = match camera.projection {
        Projection::Perspective { fovy } => {
            let scale = 1.0 / libm::tan(fovy.to_radians() / 2.0);
            [
                DVec4::X * (scale / aspect),
                DVec4::Y * scale,
                DVec4::new(0.0, 0.0, -(far + near) / depth, -2.0 * far * near / depth),
                -DVec4::Z,
            ]
        }
        Projection::Orthographic { half_height } => [
            DVec4::X / (half_height * aspect),
            DVec4::Y / half_height,
            DVec4::new(0.0, 0.0, -2.0 / depth, -(far + near) / depth),
            DVec4::W,
        ],
    };
    DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
}

/// Returns the matrix from clip space to pixels and a depth from 0 to 1.
fn viewport(scene: &Scene) -> DMat4 {
    let [x, y] = [scene.width, scene.height].map(|side| f64::from(side) / 2.0);
    DMat4::from_cols(
        DVec4::X * x,
        DVec4::Y * -y,
        DVec4::Z * 0.5,
        DVec4::new(x, y, 0.5, 1.0),
    )
}

fn matrix(matrix: DMat4) -> Value {
    let row = |i: usize| Value::vector(matrix.row(i).to_array());
    Value::List((0..4).map(row).collect())
}

fn point(p: DVec3) -> Value {
    Value::vector(p.to_array())
}

fn colour(c: Rgb) -> Value {
    Value::List(c.map(Value::Single).into())
}

/// Returns all entries.
pub fn entries(scene: &Scene, name: &str, mesh: &Mesh) -> Vec<Entry> {
    let mut all = camera(scene, name);
    all.extend(lights(scene));
    let of_material = |NamedMaterial { name, material: k }: &NamedMaterial| {
        Vec::from([
            Value::Text(name.clone()),
            colour(k.ambient),
            colour(k.diffuse),
            colour(k.specular),
            Value::Single(exponent(scene, k)),
        ])
    };
    let table = Table {
        one: "material",
        columns: MATERIAL,
        rows: mesh.materials.iter().map(of_material).collect(),
    };
    let says = "The materials, as in mesh.mtl. n is the exponent of the highlight.";
    all.push(Entry::new("materials", says, Value::Table(table)));
    all.extend(highlights(scene));
    all.extend(surfaces(scene));
    all.extend(pixels(scene, mesh.is_coloured));
    all
}

fn camera(scene: &Scene, name: &str) -> Vec<Entry> {
    let camera = &scene.camera;
    let (view, projection, viewport) = (view(scene), projection(scene), viewport(scene));
    let (fovy, half_height) = match camera.projection {
        Projection::Perspective { fovy } => (Value::Number(fovy), Value::Missing),
        Projection::Orthographic { half_height } => (Value::Missing, Value::Number(half_height)),
    };
    let is_perspective = matches!(camera.projection, Projection::Perspective { .. });
    let text = |text: &str| Value::Text(text.into());
    // C has no strings of over 509 characters.
    let name: String = name.chars().take(200).collect();
    Vec::from([
        Entry::new(
            "name",
            "The scene, as `fastphong diagnose mine.png` takes it.",
            text(&name),
        ),
        Entry::new(
            "width",
            "The picture in pixels. Row 0 is at the top; the centre of pixel (0, 0) is (0.5, 0.5).",
            Value::Whole(scene.width),
        ),
        Entry::new("height", "", Value::Whole(scene.height)),
        Entry::new(
            "expected",
            "The right picture, in Phong shading.",
            text("expected.png"),
        ),
        Entry::new("mesh", "All objects in world space.", text("mesh.obj")),
        Entry::new(
            "view",
            "World to view space: the eye is at 0, x to the right, y upward, the line of sight along -z. Row-major, for columns: p' = M p.",
            matrix(view),
        ),
        Entry::new(
            "projection",
            "View to clip space as in OpenGL: x and y from -w to w, y upward, z from -w (near) to w (far).",
            matrix(projection),
        ),
        Entry::new(
            "viewport",
            "Clip space, divided by w, to pixels: x to the right, y DOWNWARD from the top edge, z from 0 (near) to 1 (far).",
            matrix(viewport),
        ),
        Entry::new(
            "world_to_pixel",
            "viewport * projection * view: divide the result by its w.",
            matrix(viewport * projection * view),
        ),
        Entry::new(
            "perspective",
            "True: perspective with this field of view in degrees, from bottom to top. False: parallel rays, half of the visible height.",
            Value::Flag(is_perspective),
        ),
        Entry::new("fovy", "", fovy),
        Entry::new("half_height", "", half_height),
        Entry::new("eye", "The camera in the world.", point(camera.eye)),
        Entry::new("target", "", point(camera.target)),
        Entry::new("up", "", point(camera.up)),
        Entry::new(
            "near",
            "Distances of the near and the far plane.",
            Value::Number(camera.near),
        ),
        Entry::new("far", "", Value::Number(camera.far.min(FARTHEST))),
    ])
}

fn lights(scene: &Scene) -> Vec<Entry> {
    let to_view = view(scene);
    let row = |light: &Light| {
        let (is_positional, direction, position) = match light.place {
            Place::Infinite(l) => (false, Some(unit(l)), None),
            Place::Local(p) => (true, None, Some(p)),
        };
        let (falloff, k) = match light.falloff {
            _ if !is_positional => ("none", 0.0),
            Falloff::None => ("none", 0.0),
            Falloff::Attenuation(k) => ("attenuation", k),
            Falloff::InverseSquare => ("inverse-square", 0.0),
            Falloff::Inverse => ("inverse", 0.0),
        };
        let direction_view = direction.map(|l| to_view.transform_vector3(l));
        let position_view = position.map(|p| to_view.transform_point3(p));
        let or_none = |v: Option<DVec3>| v.map_or(Value::NoVector, point);
        Vec::from([
            Value::Flag(is_positional),
            or_none(direction),
            or_none(direction_view),
            or_none(position),
            or_none(position_view),
            colour(light.colour),
            word(falloff),
            Value::Single(k),
        ])
    };
    let table = Table {
        one: "light",
        columns: LIGHT,
        rows: scene.lights.iter().map(row).collect(),
    };
    Vec::from([
        Entry::new(
            "ambient",
            "The ambient intensity, once for all lights.",
            colour(scene.ambient),
        ),
        Entry::new(
            "lights",
            "The lights. A direction is the unit vector TOWARD the light. Falloff over the distance r: none, attenuation 1/(1 + k r^2), inverse-square 1/r^2, inverse 1/r.",
            Value::Table(table),
        ),
    ])
}

/// Returns the rules of highlights.
fn highlights(scene: &Scene) -> Vec<Entry> {
    let to_eye = (!scene.local_viewer).then(|| scene.camera.view());
    let flag = Value::Flag;
    Vec::from([
        Entry::new(
            "blinn",
            "The highlight's cosine. False: R.V with R = 2 (L.N) N - L. True: N.H with H = (L + V) / |L + V|. A negative one counts as 0.",
            flag(scene.specular == SpecularModel::Blinn),
        ),
        Entry::new(
            "local_viewer",
            "V. True: from the point to the eye, normalised. False: this unit vector everywhere, (0, 0, 1) in view space.",
            flag(scene.local_viewer),
        ),
        Entry::new("to_eye", "", to_eye.map_or(Value::NoVector, point)),
        Entry::new(
            "gate",
            "Highlights where L.N <= 0: gated = none; ungated = as everywhere; weighted = everywhere times max(L.N, 0).",
            word(match scene.gate {
                SpecularGate::Gated => "gated",
                SpecularGate::Ungated => "ungated",
                SpecularGate::Weighted => "weighted",
            }),
        ),
    ])
}

/// Returns which surfaces are seen.
fn surfaces(scene: &Scene) -> Vec<Entry> {
    let (visibility, key) = match scene.hidden_surfaces {
        HiddenSurfaces::ZBuffer(_) => ("z-buffer", "none"),
        HiddenSurfaces::Painter(PainterKey::Mean) => ("painter", "mean"),
        HiddenSurfaces::Painter(PainterKey::Farthest) => ("painter", "farthest"),
        HiddenSurfaces::DrawOrder => ("draw-order", "none"),
    };
    let (bits, source) = match scene.hidden_surfaces {
        HiddenSurfaces::ZBuffer(buffer) => {
            let bits = buffer.bits.most().map_or(32, u32::count_ones);
            (bits, buffer.source)
        }
        _ => (32, DepthSource::Interpolated),
    };
    Vec::from([
        Entry::new(
            "culling",
            "Faces that are left out: back (clockwise on the picture), front, or none.",
            word(match scene.culling {
                Culling::Back => "back",
                Culling::Front => "front",
                Culling::None => "none",
            }),
        ),
        Entry::new(
            "two_sided",
            "True: faces seen clockwise are lit with negated normals.",
            Value::Flag(scene.two_sided),
        ),
        Entry::new(
            "visibility",
            "Hidden surfaces: z-buffer (the nearest, at equal depth the first), painter (sorted from back to front), or draw-order (the last face).",
            word(visibility),
        ),
        Entry::new("painter_key", "The painter's sorting key.", word(key)),
        Entry::new(
            "depth_bits",
            "Bits of the depth buffer, 16, 24 or 32 (floats), and where depth comes from.",
            Value::Whole(bits),
        ),
        Entry::new(
            "depth_source",
            "",
            word(match source {
                DepthSource::Interpolated => "interpolated",
                DepthSource::PerSample => "per-sample",
            }),
        ),
        Entry::new(
            "clipping",
            "planes, or ndc-cube: CS171's test at each pixel.",
            word(match scene.clipping {
                Clipping::Planes => "planes",
                Clipping::NdcCube => "ndc-cube",
            }),
        ),
    ])
}

/// Returns how pixels are computed and stored.
fn pixels(scene: &Scene, is_coloured: bool) -> Vec<Entry> {
    let flag = Value::Flag;
    Vec::from([
        Entry::new(
            "perspective_correct",
            "Normals, positions and colours between corners. True: perspective-correct. False: linear on the screen.",
            flag(scene.interpolation == Interpolation::Perspective),
        ),
        Entry::new(
            "vertex_colours",
            "True: the colours of v lines (linear) multiply ka and kd.",
            flag(is_coloured),
        ),
        Entry::new(
            "background",
            "The linear colour where nothing is drawn.",
            colour(scene.background),
        ),
        Entry::new(
            "srgb",
            "A level is round(255 c), c clamped to 0..1. True: c is encoded as sRGB first.",
            flag(scene.encoding == Encoding::Srgb),
        ),
    ])
}
