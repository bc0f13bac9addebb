//! Perspective: Lecture 5's checkerboard wrong and right, the weight that makes it right, and what becomes of depth.

use super::stage::{stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Plot, Scale, Series, Shown};
use crate::frame::perspective::{Frustum, printed_weight_in_space, weight_in_space};
use crate::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use crate::mesh::vertex_normals::NormalSource;
use crate::mesh::{Material, MeshBuilder, PolygonMesh};
use crate::picture::LinearPicture;
use crate::raster::{checkerboard, vertex_colours};
use crate::scene::{Camera, Culling, Interpolation, Lighting, Object, Projection, Scene};
use alloc::format;
use alloc::sync::Arc;
use alloc::vec::Vec;
use glam::{DAffine3, DVec3, Vec3};

pub(super) static FIGURE: Figure = Figure {
    name: "perspective",
    title: "Perspective: the checkerboard, wrong and right",
    lecture: "L5, Perspective Projection and Interpolation",
    make,
};

const WIDTH: usize = 128;
const HEIGHT: usize = 96;
/// The colours of the board, and the side of a square.
const BOARD: [[f32; 3]; 2] = [[0.9; 3], [0.15, 0.2, 0.45]];
const SQUARE: f64 = 1.0;
/// Half of the side of the floor.
const REACH: f64 = 4.0;

fn camera() -> Camera {
    Camera {
        eye: DVec3::new(1.0, 2.4, 6.5),
        target: DVec3::new(0.0, -0.2, 0.0),
        up: DVec3::Y,
        projection: Projection::Perspective { fovy: 50.0 },
        near: 1.0,
        far: 40.0,
    }
}

/// The floor, whole or cut along a diagonal.
fn floor(triangles: bool) -> Result<PolygonMesh, FigureError> {
    let r = REACH as f32;
    let corners = [(-r, -r), (-r, r), (r, r), (r, -r)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let mut builder = MeshBuilder::new(corners.to_vec());
    if triangles {
        builder.polygon(&[0, 1, 2]).polygon(&[0, 2, 3]);
    } else {
        builder.polygon(&[0, 1, 2, 3]);
    }
    Ok(builder.finish()?)
}

fn board(triangles: bool, interpolation: Interpolation) -> Result<LinearPicture, FigureError> {
    let object = Object {
        mesh: Arc::new(floor(triangles)?),
        transform: DAffine3::IDENTITY,
        material: None,
        normals: NormalSource::Averaged,
    };
    let scene = Scene {
        width: WIDTH as u32,
        height: HEIGHT as u32,
        interpolation,
        culling: Culling::None,
        objects: [object].into(),
        ..Scene::new(camera())
    };
    Ok(checkerboard(&scene.frame()?, SQUARE, BOARD))
}

/// The colour of the board where the ray of each pixel meets the floor.
fn ray(x: usize, y: usize) -> Option<[f32; 3]> {
    let camera = camera();
    let Projection::Perspective { fovy } = camera.projection else {
        return None;
    };
    let [right, up, forward] = camera.axes();
    let scale = libm::tan(fovy.to_radians() / 2.0);
    let (u, v) = (
        (2 * x + 1) as f64 / WIDTH as f64 - 1.0,
        1.0 - (2 * y + 1) as f64 / HEIGHT as f64,
    );
    let ray = forward + right * (u * scale * WIDTH as f64 / HEIGHT as f64) + up * (v * scale);
    let p = camera.eye - camera.eye.y / ray.y * ray;
    let is_met = ray.y < 0.0 && p.x.abs() < REACH && p.z.abs() < REACH;
    let squares = libm::floor(p.x / SQUARE) + libm::floor(p.z / SQUARE);
    is_met.then(|| BOARD[usize::from(squares.rem_euclid(2.0) != 0.0)])
}

/// The part of the rays that meet the floor, in per cent, that the picture has in the other colour.
fn wrong(picture: &LinearPicture) -> f64 {
    let (mut wrong, mut all) = (0, 0);
    for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
        if let Some(colour) = ray(x, y) {
            wrong += usize::from(picture.get(x, y)[..3] != colour);
            all += 1;
        }
    }
    100.0 * wrong as f64 / f64::from(all.max(1))
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let pictures = [
        (
            "screen",
            "linear on the screen",
            board(false, Interpolation::Screen)?,
        ),
        (
            "screen-triangles",
            "the same, cut into two triangles",
            board(true, Interpolation::Screen)?,
        ),
        (
            "space",
            "linear in space",
            board(true, Interpolation::Perspective)?,
        ),
    ];
    content.text(
        "A floor of eight by eight squares, its world coordinates interpolated and the board computed at each pixel. Linear \
         on the screen, the squares are of one size and bend at the diagonal of the triangles; linear in space, they are \
         those that the rays of the pixels meet.",
    );
    let shown = |(_, caption, picture): &(&str, &str, LinearPicture)| {
        Shown::new(
            *caption,
            format!("A checkerboard seen in perspective, {caption}."),
            stored(picture),
        )
    };
    content.pictures(3, pictures.iter().map(shown).collect());
    for (key, how, picture) in &pictures {
        let wrong = wrong(picture);
        let is_space = *key == "space";
        let verdict = match (wrong < 0.5, is_space) {
            (true, _) => {
                "The board is right: only pixels on the rim of a square may fall to either side."
            }
            (false, true) => "The board is wrong.",
            (false, false) => "The board is wrong, as the slide shows it.",
        };
        content.found(Finding::new(
            format!("wrong-{key}"),
            format!("pixels of the floor in the wrong colour, {how}"),
            (wrong, "%"),
            Agreement::if_holds((wrong < 0.5) == is_space),
            verdict,
        ));
    }
    weight(&mut content)?;
    depth(&mut content);
    Ok(content)
}

/// Depths of the two ends of an edge.
const ENDS: [f64; 2] = [1.0, 4.0];
/// Pixels between them.
const STRIP: usize = 128;

/// A strip from A, on its left, to B: the red of A is 1, that of B 0, so that red is the weight of A.
fn strip() -> Result<Frame, FigureError> {
    let mut builder = FrameBuilder::new(STRIP as u32, 1);
    builder.interpolation(Interpolation::Perspective);
    let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
    let corners = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(end, y): (usize, i32)| {
        let number = builder.vertex(Vertex {
            x: SubPixel::from_num(end * STRIP),
            y: SubPixel::from_num(y),
            depth: 0.5,
            inv_w: (1.0 / ENDS[end]) as f32,
            normal: [0.0, 0.0, 1.0],
            material,
        });
        builder.colour(number, [[1.0, 0.0, 0.0], [0.0; 3]][end]);
        number
    });
    builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
    Ok(builder.finish()?)
}

/// The weight of A along an edge: as the engine has it, corrected, and as printed.
fn weight(content: &mut Content) -> Result<(), FigureError> {
    let [z_a, z_b] = ENDS;
    let drawn = vertex_colours(&strip()?);
    let alpha = |x: usize| 1.0 - (x as f64 + 0.5) / STRIP as f64;
    let engine: Vec<(f64, f64)> = (0..STRIP)
        .map(|x| (alpha(x), f64::from(drawn.get(x, 0)[0])))
        .collect();
    let curve = |of: &dyn Fn(f64) -> f64| {
        (0..STRIP)
            .map(|x| (alpha(x), of(alpha(x))))
            .collect::<Vec<_>>()
    };
    let corrected = curve(&|alpha| weight_in_space(alpha, z_a, z_b));
    let printed = curve(&|alpha| printed_weight_in_space(alpha, z_a, z_b));
    let off = |curve: &[(f64, f64)]| {
        engine
            .iter()
            .zip(curve)
            .fold(0.0f64, |m, (e, c)| m.max((e.1 - c.1).abs()))
    };
    let (right, wrong) = (off(&corrected), off(&printed));
    content.plot(Plot {
        title: "The weight in space of the end A of an edge".into(),
        x: ("α, the weight of A on the screen".into(), Scale::Linear),
        y: ("β, the weight of A in space".into(), Scale::Linear),
        series: [
            Series::new("the engine", engine.into_iter().step_by(8)),
            Series::new("α z_B / (α z_B + (1 − α) z_A)", corrected),
            Series::new("as printed", printed),
            Series::new("linear on the screen", curve(&|alpha| alpha)),
        ]
        .into(),
        marks: Vec::new(),
        caption: format!(
            "From A at depth {z_a} to B at depth {z_b}. What the slide prints is the weight of B: at A, where α = 1, it is 0."
        ),
    });
    let is_printed = wrong < 1e-3;
    content.claim(
        "printed-weight",
        "largest difference of the printed weight from the engine's",
        (wrong, ""),
        is_printed,
        [
            "The weight is as printed.",
            "(1 − α) z_A / (z_B + (1 − α)(z_A − z_B)) weighs the other end.",
        ],
    );
    content.adds("weight", "largest difference of the corrected weight from the engine's", (right, ""), if right < 1e-4 {
            "The engine, which divides interpolated values by interpolated weights, has this weight.".into()
        } else {
            format!("The engine's weight is off by {}.", written(right))
        });
    Ok(())
}

/// "Z-value is preserved after projection."
fn depth(content: &mut Content) {
    let Camera { near, far, .. } = camera();
    let frustum = Frustum {
        left: -1.0,
        right: 1.0,
        bottom: -1.0,
        top: 1.0,
        near,
        far,
    };
    let middle = frustum.ndc_depth(-(near + far) / 2.0);
    let is_preserved = middle.abs() < 0.01;
    content.claim("depth", "NDC depth, −1 to 1, of the point half-way between near and far plane", (middle, ""), is_preserved, ["Depth keeps its value, up to scale.".into(), format!(
                "Depth keeps its order and not its value: half of the range goes to the first {} % of the way from near to far.",
                written(100.0 * (2.0 * far * near / (far + near) - near) / (far - near))
            )]);
}
