//! Barycentric coordinates: the triangle from red to blue, the weights as colours, and what two slips of the pen draw.

use super::stage::{stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Shown};
use crate::picture::{LinearPicture, Picture};
use crate::reference::cs171::barycentric::{
    Weights, centre_of_mass, printed_gamma, signed_area, unsigned_weights, weights,
};
use crate::reference::cs171::{Inside, Raster, raster_colored_triangle, raster_triangle};
use alloc::format;
use glam::{DVec2, DVec3};

pub(super) static FIGURE: Figure = Figure {
    name: "barycentric",
    title: "Barycentric coordinates: right, as printed, and without signs",
    lecture: "CS171 1; L5, Barycentric Coordinates",
    make,
};

/// Width and height of the pictures.
const SIDE: usize = 72;

/// The right triangle of the notes: the hypotenuse from `a` to `b`, the right angle at `c`.
const TRIANGLE: [DVec2; 3] = [
    DVec2::new(8.0, 6.0),
    DVec2::new(66.0, 64.0),
    DVec2::new(8.0, 64.0),
];

/// Centres of all pixels.
fn pixels() -> impl Iterator<Item = (usize, usize, DVec2)> {
    (0..SIDE * SIDE)
        .map(|i| (i % SIDE, i / SIDE))
        .map(|(x, y)| (x, y, DVec2::new(x as f64 + 0.5, y as f64 + 0.5)))
}

/// True if Algorithm 1 fills a pixel of these weights.
fn is_in(weights: Weights) -> bool {
    weights.iter().all(|w| (0.0..=1.0).contains(w))
}

/// The weights as printed: γ is not one.
fn as_printed(p: DVec2) -> Weights {
    let [alpha, beta, _] = weights(TRIANGLE, p);
    [alpha, beta, printed_gamma(TRIANGLE, p)]
}

/// Every pixel that `weights_at` calls inside, in the colour of its weights.
fn painted(weights_at: impl Fn(DVec2) -> Weights) -> LinearPicture {
    let mut picture = Picture::new(SIDE, SIDE, [0.0; 4]);
    for (x, y, p) in pixels() {
        let w = weights_at(p);
        if is_in(w) {
            let [r, g, b] = w.map(|w| w as f32);
            picture.row_mut(y)[x] = [r, g, b, 1.0];
        }
    }
    picture
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let mut grid = Raster::new(SIDE, SIDE, DVec3::ZERO);
    raster_colored_triangle(
        TRIANGLE,
        [DVec3::X, DVec3::X, DVec3::Z],
        Inside::Closed,
        &mut grid,
    );
    let gradient = grid.colours.map(|texel| texel.map(|c| c as f32));
    let mut right = painted(|p| weights(TRIANGLE, p));
    let centre = centre_of_mass(TRIANGLE);
    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        right.row_mut(centre.y as usize + dy)[centre.x as usize + dx] = [1.0; 4];
    }
    let printed = painted(as_printed);
    let unsigned = painted(|p| unsigned_weights(TRIANGLE, p));
    content.text(
        "A right triangle by CS171's Algorithm 2: red at both ends of the hypotenuse, blue at the right angle. Beside it \
         the weights themselves, α red, β green, γ blue, with the centre of mass in white. Then what Algorithm 1 fills if γ \
         is divided by f_ac(p), as the notes print it, in place of f_ab(c); and what it fills if the weights are areas \
         without signs, as the slides of Lecture 5 print them: all there is.",
    );
    let shown = |caption: &str, alt: &str, picture: &LinearPicture| {
        Shown::new(caption, alt, stored(picture))
    };
    content.pictures(
        4,
        [
            shown(
                "from red to blue (Algorithm 2)",
                "A right triangle that goes from red to blue.",
                &gradient,
            ),
            shown(
                "the weights",
                "A triangle with a red, a green and a blue corner.",
                &right,
            ),
            shown(
                "γ as printed",
                "What of the triangle is filled with the wrong γ.",
                &printed,
            ),
            shown(
                "areas without signs",
                "A square that is coloured all over.",
                &unsigned,
            ),
        ]
        .into(),
    );
    counted(&mut content);
    measured(&mut content);
    Ok(content)
}

/// Pixels that the two slips lose or gain.
fn counted(content: &mut Content) {
    let (mut inside, mut lost, mut outside, mut gained, mut elsewhere) = (0, 0, 0, 0, 0);
    for (_, _, p) in pixels() {
        if is_in(weights(TRIANGLE, p)) {
            inside += 1;
            lost += usize::from(!is_in(as_printed(p)));
        } else {
            outside += 1;
            elsewhere += usize::from(is_in(as_printed(p)));
            gained += usize::from(is_in(unsigned_weights(TRIANGLE, p)));
        }
    }
    let share = |part: usize, all: usize| 100.0 * part as f64 / all.max(1) as f64;
    let lost = share(lost, inside);
    content.claim("printed-gamma", "pixels of the triangle that the printed γ loses", (lost, "%"), lost == 0.0, ["The printed γ fills the triangle as the corrected one does.", "f_ab(p) / f_ac(p) is no weight but −γ/β, below 0 inside: divide by f_ab(c). What is left is the edge ab."]);
    let elsewhere = share(elsewhere, inside);
    content.claim(
        "printed-gamma-outside",
        "pixels outside that it fills, in parts of the triangle",
        (elsewhere, "%"),
        elsewhere == 0.0,
        [
            "It fills nothing outside.",
            "It fills another triangle, beyond the edge ab, where γ is below 0.",
        ],
    );
    let gained = share(gained, outside);
    content.claim("unsigned-areas", "pixels outside that areas without signs call inside", (gained, "%"), gained == 0.0, ["Areas need no signs.", "Quotients of areas without signs lie in 0..1 wherever the point is: the signs tell inside from outside."]);
}

/// What the lectures say of the weights.
fn measured(content: &mut Content) {
    let mut worst = [0.0f64; 2];
    let [a, b, c] = TRIANGLE;
    let leg = b.x - a.x;
    raster_triangle(
        TRIANGLE,
        [SIDE, SIDE],
        Inside::Closed,
        |x, y, [_, beta, gamma]| {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let area = signed_area([a, p, c]) / signed_area(TRIANGLE);
            // The distance from the hypotenuse, over that of the right angle: both along a leg.
            let distance = ((p.y - a.y) - (p.x - a.x)) / leg;
            worst = [
                worst[0].max((area - beta).abs()),
                worst[1].max((distance - gamma).abs()),
            ];
        },
    );
    let thirds = weights(TRIANGLE, centre_of_mass(TRIANGLE));
    let centre = thirds
        .iter()
        .fold(0.0f64, |worst, w| worst.max((w - 1.0 / 3.0).abs()));
    for (key, label, value, holds) in [
        (
            "area",
            "largest difference of A_b / A from β",
            worst[0],
            "Areas are the weights.",
        ),
        (
            "distance",
            "largest difference of the distance from ab from γ",
            worst[1],
            "Distances are the weights.",
        ),
        (
            "centre",
            "largest difference of a weight at the centre of mass from ⅓",
            centre,
            "It weighs all corners alike.",
        ),
    ] {
        // Quotients of numbers below 2¹³ that round a few times each, about sums that cancel at most their last 13 bits.
        let is_so = value < 1e-12;
        let verdict = if is_so {
            holds.into()
        } else {
            format!("It is off by {}.", written(value))
        };
        content.found(Finding::new(
            key,
            label,
            (value, ""),
            Agreement::if_holds(is_so),
            verdict,
        ));
    }
}
