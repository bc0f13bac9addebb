//! Perspective: Lecture 5's checkerboard, wrong and right, the weight that makes it right, and the
//! depth of a point.

use super::prelude::*;
use fastphong::frame::perspective::{Frustum, printed_weight_in_space, weight_in_space};
use fastphong::frame::{FrameBuilder, Vertex, sub_pixel};
use fastphong::raster::{checkerboard, vertex_colours};

pub(super) static FIGURE: Figure = Figure {
    name: "perspective",
    title: "Perspective: the checkerboard, wrong and right",
    lecture: "L5, Perspective Projection and Interpolation",
    parts: &[boards, weight, depth],
    live: None,
};

const WIDTH: usize = 128;
const HEIGHT: usize = 96;
/// The two colours of the board, and the side of a square.
const BOARD: [[f32; 3]; 2] = [[0.9; 3], [0.15, 0.2, 0.45]];
const SQUARE: f64 = 1.0;
/// Half the side of the floor.
const REACH: f64 = 4.0;
/// Vertical field of view, in degrees.
const FOVY: f64 = 50.0;

fn camera() -> Camera {
    let (eye, target) = (DVec3::new(1.0, 2.4, 6.5), DVec3::new(0.0, -0.2, 0.0));
    let mut camera = Camera::looking_at(eye, target, Projection::Perspective { fovy: FOVY });
    (camera.near, camera.far) = (1.0, 40.0);
    camera
}

/// Draws the board on a floor of these polygons.
fn board(polygons: &[&[u32]], interpolation: Interpolation) -> Result<LinearPicture> {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
        .map(|(x, z)| REACH * DVec3::new(x, 0.0, z));
    let mut scene = bare(&corners, polygons, camera(), [WIDTH as u32, HEIGHT as u32])?;
    scene.interpolation = interpolation;
    Ok(checkerboard(&scene.frame()?, None, SQUARE, BOARD))
}

/// Returns the colour of the board where the ray of a pixel meets the floor.
fn ray(x: usize, y: usize) -> Option<[f32; 3]> {
    let camera = camera();
    let [right, up, forward] = camera.axes();
    let scale = libm::tan(FOVY.to_radians() / 2.0);
    let u = (2 * x + 1) as f64 / WIDTH as f64 - 1.0;
    let v = 1.0 - (2 * y + 1) as f64 / HEIGHT as f64;
    let ray = forward + right * (u * scale * WIDTH as f64 / HEIGHT as f64) + up * (v * scale);
    let p = camera.eye - camera.eye.y / ray.y * ray;
    let is_met = ray.y < 0.0 && p.x.abs() < REACH && p.z.abs() < REACH;
    let squares = libm::floor(p.x / SQUARE) + libm::floor(p.z / SQUARE);
    is_met.then(|| BOARD[usize::from(squares.rem_euclid(2.0) != 0.0)])
}

/// Returns how many per cent of the rays that meet the floor see another colour than the picture
/// has.
fn wrong(picture: LinearPicture) -> f64 {
    let pixels = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let met = pixels.filter_map(|(x, y)| Some(picture.get(x, y)[..3] != ray(x, y)?));
    let is_wrong: Vec<bool> = met.collect();
    percent(is_wrong.iter().filter(|is| **is).count(), is_wrong.len())
}

fn boards(content: &mut FigureContent) -> Result {
    content.text(
        "A floor of eight by eight squares. Each pixel computes its square from interpolated world \
         coordinates. If they are linear on the screen, all squares have the same size and bend at the \
         diagonal. If they are linear in space, each pixel has the colour that its ray meets.",
    );
    let whole: &[&[u32]] = &[&[0, 1, 2, 3]];
    let triangles: &[&[u32]] = &[&[0, 1, 2], &[0, 2, 3]];
    let screen = board(whole, Interpolation::Screen)?;
    let cut = board(triangles, Interpolation::Screen)?;
    let space = board(triangles, Interpolation::Perspective)?;
    content.row(
        "A checkerboard seen in perspective",
        "linear on the screen | linear on the screen, as two triangles | linear in space",
        [&screen, &cut, &space].map(stored),
    );
    let [screen, cut, space] = [screen, cut, space].map(wrong);
    content.confirms(
        "wrong-screen | pixels of the floor in the wrong colour, linear on the screen",
        (screen, "%", screen >= 0.5),
        "The board is wrong, as the slide shows it.",
    );
    content.confirms(
        "wrong-screen-triangles | pixels of the floor in the wrong colour, linear on the screen, as two \
         triangles",
        (cut, "%", cut >= 0.5),
        "The board is wrong, as the slide shows it.",
    );
    content.confirms(
        "wrong-space | pixels of the floor in the wrong colour, linear in space",
        (space, "%", space < 0.5),
        "The board is right: only a pixel on the rim of a square may fall to either side.",
    );
    Ok(())
}

/// The depths of the two ends of an edge.
const ENDS: [f64; 2] = [1.0, 4.0];
/// How many pixels lie between them.
const STRIP: usize = 128;

/// Draws a strip from A on the left to B on the right. Red is 1 at A and 0 at B, so a pixel's red
/// is the weight of A.
fn strip() -> Result<LinearPicture> {
    let mut builder = FrameBuilder::new(STRIP as u32, 1);
    builder.interpolation(Interpolation::Perspective);
    let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
    let corners = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(end, y): (usize, i32)| {
        let index = builder.vertex(Vertex {
            x: sub_pixel((end * STRIP) as f64),
            y: sub_pixel(y),
            depth: 0.5,
            inv_w: 1.0 / ENDS[end],
            normal: [0.0, 0.0, 1.0],
            material,
        });
        builder.colour(index, [[1.0, 0.0, 0.0], [0.0; 3]][end]);
        index
    });
    builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
    Ok(vertex_colours(&builder.finish()?, None))
}

/// Compares the engine's weight of A along an edge with the corrected and with the printed formula.
fn weight(content: &mut FigureContent) -> Result {
    let [z_a, z_b] = ENDS;
    let drawn = strip()?;
    let alphas = || (0..STRIP).map(|x| 1.0 - (x as f64 + 0.5) / STRIP as f64);
    let red = drawn.row(0).iter().map(|pixel| f64::from(pixel[0]));
    let engine: Vec<(f64, f64)> = alphas().zip(red).collect();
    let corrected = |alpha| weight_in_space(alpha, z_a, z_b);
    let printed = |alpha| printed_weight_in_space(alpha, z_a, z_b);
    let off = |weight: &dyn Fn(f64) -> f64| {
        let error = |(alpha, drawn): &(f64, f64)| (drawn - weight(*alpha)).abs();
        largest(engine.iter().map(error))
    };
    let (right, wrong) = (off(&corrected), off(&printed));
    let on_screen = linear("α, the weight of A on the screen");
    content.plot(Plot::new(
        "The weight in space of the end A of an edge",
        [on_screen, linear("β, the weight of A in space")],
        [
            Series::new("the engine", engine.into_iter().step_by(8)),
            Series::sampled("α z_B / (α z_B + (1 − α) z_A)", alphas(), corrected),
            Series::sampled("as printed", alphas(), printed),
            Series::sampled("linear on the screen", alphas(), |alpha| alpha),
        ],
        format!(
            "From A at depth {z_a} to B at depth {z_b}. The formula on the slide is the weight of B: at A, \
             where α = 1, it is 0."
        ),
    ));
    content.contradicts(
        "printed-weight | largest difference of the printed weight from the engine's",
        (wrong, "", wrong >= 1e-3),
        "(1 − α) z_A / (z_B + (1 − α)(z_A − z_B)) is the weight of the other end.",
    );
    content.adds(
        "weight | largest difference of the corrected weight from the engine's",
        (right, "", right < 1e-4),
        "The engine divides interpolated values by interpolated weights, which results in this weight.",
    );
    Ok(())
}

/// Measures the depth of the point half-way between near and far plane (L5: "Z-value is preserved
/// after projection").
fn depth(content: &mut FigureContent) -> Result {
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
    let half = 2.0 * far * near / (far + near);
    let part = written(100.0 * (half - near) / (far - near));
    content.contradicts(
        "depth | NDC depth, −1 to 1, of the point half-way between near and far plane",
        (middle, "", middle.abs() >= 0.01),
        &format!(
            "Depth preserves the order, not the value: the first {part} % of the way use half of the range."
        ),
    );
    Ok(())
}
