//! Barycentric coordinates: the triangle from red to blue, the weights as colours, and pictures of
//! two misprints.

use super::prelude::*;
use fastphong::picture::Picture;
use fastphong::reference::cs171::barycentric::{
    Weights, centre_of_mass, printed_gamma, signed_area, unsigned_weights, weights,
};
use fastphong::reference::cs171::{Inside, Raster, raster_colored_triangle, raster_triangle};

pub(super) static FIGURE: Figure = Figure {
    name: "barycentric",
    title: "Barycentric coordinates: right, as printed, and without signs",
    lecture: "CS171 1; L5, Barycentric Coordinates",
    parts: &[pictures, misprints, other_formulas],
    live: None,
};

/// Width and height of the pictures.
const SIDE: usize = 72;

/// The right triangle of the notes. The hypotenuse runs from `a` to `b`; the right angle is at `c`.
const TRIANGLE: [DVec2; 3] = [
    DVec2::new(8.0, 6.0),
    DVec2::new(66.0, 64.0),
    DVec2::new(8.0, 64.0),
];

/// Returns the centres of all pixels, row by row.
fn pixels() -> impl Iterator<Item = DVec2> {
    (0..SIDE * SIDE).map(|i| DVec2::new((i % SIDE) as f64 + 0.5, (i / SIDE) as f64 + 0.5))
}

/// True if Algorithm 1 fills a pixel with these weights.
fn is_in(weights: Weights) -> bool {
    weights.iter().all(|w| (0.0..=1.0).contains(w))
}

fn exact(p: DVec2) -> Weights {
    weights(TRIANGLE, p)
}

/// Returns the weights as printed, whose γ is not a weight.
fn as_printed(p: DVec2) -> Weights {
    let [alpha, beta, _] = exact(p);
    [alpha, beta, printed_gamma(TRIANGLE, p)]
}

fn without_signs(p: DVec2) -> Weights {
    unsigned_weights(TRIANGLE, p)
}

/// Draws every pixel that is inside according to `weights`, with its weights as its colour.
fn painted(weights: fn(DVec2) -> Weights) -> LinearPicture {
    let mut picture = Picture::new(SIDE, SIDE, [0.0; 4]);
    for (pixel, p) in picture.pixels_mut().iter_mut().zip(pixels()) {
        if is_in(weights(p)) {
            let [r, g, b] = weights(p).map(|w| w as f32);
            *pixel = [r, g, b, 1.0];
        }
    }
    picture
}

fn pictures(content: &mut FigureContent) -> Result {
    content.text(
        "A right triangle drawn by CS171's Algorithm 2, then its weights as colours: α is red, β \
         green, γ blue, and the centre of mass white. Then two misprints. The notes divide γ by \
         f_ac(p) in place of f_ab(c). Lecture 5's slides compute areas without signs.",
    );
    let mut grid = Raster::new(SIDE, SIDE, DVec3::ZERO);
    let colours = [DVec3::X, DVec3::X, DVec3::Z];
    raster_colored_triangle(TRIANGLE, colours, Inside::Closed, &mut grid);
    let gradient = grid.colours.map(|pixel| pixel.map(|c| c as f32));
    let mut right = painted(exact);
    let centre = centre_of_mass(TRIANGLE);
    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        right.row_mut(centre.y as usize + dy)[centre.x as usize + dx] = [1.0; 4];
    }
    let pictures = [gradient, right, painted(as_printed), painted(without_signs)];
    content.row(
        "A right triangle",
        "from red to blue (Algorithm 2) | the weights | γ as printed | areas without signs",
        pictures.each_ref().map(stored),
    );
    Ok(())
}

/// Counts the pixels that the two misprints lose or gain.
fn misprints(content: &mut FigureContent) -> Result {
    let count = |is: &dyn Fn(DVec2) -> bool| pixels().filter(|p| is(*p)).count();
    let is_inside = |p| is_in(exact(p));
    let inside = count(&is_inside);
    let lost = percent(count(&|p| is_inside(p) && !is_in(as_printed(p))), inside);
    content.contradicts(
        "printed-gamma | pixels of the triangle that the printed γ loses",
        (lost, "%", lost != 0.0),
        "f_ab(p) / f_ac(p) is −γ/β, which is not a weight: divide by f_ab(c). Only the edge ab is left.",
    );
    let elsewhere = percent(count(&|p| !is_inside(p) && is_in(as_printed(p))), inside);
    content.contradicts(
        "printed-gamma-outside | pixels outside that it fills, in parts of the triangle",
        (elsewhere, "%", elsewhere != 0.0),
        "It fills another triangle, on the other side of the edge ab, where γ is negative.",
    );
    let gained = percent(
        count(&|p| !is_inside(p) && is_in(without_signs(p))),
        SIDE * SIDE - inside,
    );
    content.contradicts(
        "unsigned-areas | pixels outside that areas without signs count as inside",
        (gained, "%", gained != 0.0),
        "Without signs every quotient lies between 0 and 1: only the signs tell inside from outside.",
    );
    Ok(())
}

/// Compares the weights with the areas and distances that the lectures name, and with 1/3 at the
/// centre of mass.
fn other_formulas(content: &mut FigureContent) -> Result {
    let [a, b, c] = TRIANGLE;
    let (mut area, mut distance) = (0.0f64, 0.0f64);
    raster_triangle(
        TRIANGLE,
        [SIDE, SIDE],
        Inside::Closed,
        |x, y, [_, beta, gamma]| {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let share = signed_area([a, p, c]) / signed_area(TRIANGLE);
            area = area.max((share - beta).abs());
            // The distance from the hypotenuse, divided by the distance of the right angle from it;
            // measured along a leg, which scales both alike.
            let along_leg = ((p.y - a.y) - (p.x - a.x)) / (b.x - a.x);
            distance = distance.max((along_leg - gamma).abs());
        },
    );
    let centre = largest(exact(centre_of_mass(TRIANGLE)).map(|w| (w - 1.0 / 3.0).abs()));
    // Quotients of values below 2¹³, which round a few times each, of sums that cancel at most
    // 13 bits.
    let rounded = |value: f64| (value, "", value < 1e-12);
    content.confirms(
        "area | largest difference of A_b / A from β",
        rounded(area),
        "Areas are the weights.",
    );
    content.confirms(
        "distance | largest difference of the distance from ab from γ",
        rounded(distance),
        "Distances are the weights.",
    );
    content.confirms(
        "centre | largest difference of a weight at the centre of mass from ⅓",
        rounded(centre),
        "There all corners weigh the same.",
    );
    Ok(())
}
