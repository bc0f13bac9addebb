//! The square of Figure 5: what turning it, and what cutting it, does to its shading (L21 3).

use super::stage::{Corner, Facet, Grey, frame, leaning, stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Shown};
use crate::compare::metrics::difference_map;
use crate::frame::Frame;
use crate::picture::LinearPicture;
use crate::raster::normals;
use crate::shading::Variant;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "square",
    title: "The square that changes when it is turned",
    lecture: "L21 3, Figure 5; L21 4.1",
    make,
};

/// Width and height of the pictures.
const SIDE: u32 = 120;
/// From the middle to a corner, in pixels: no edge or diagonal meets a pixel centre at the quarter turns.
const REACH: f64 = 56.25;
/// Grey levels at the yellow end of the difference maps: of both diagonals, and of turned triangles.
const MAP_SCALES: [f32; 2] = [128.0, 40.0];
/// The methods that are turned.
const METHODS: [&str; 4] = ["gouraud", "naive-phong", "fast-phong", "slerp-phong"];

/// Unit normals of the corners: top, right, bottom, left, when the square is upright.
type Normals = [DVec3; 4];

/// Figure 5: three normals face the light, and that of the lowest corner is at a right angle to it.
const DARK_BELOW: Normals = [DVec3::Z, DVec3::Z, DVec3::NEG_Y, DVec3::Z];

/// Normals of which no three lie on one great circle: what is interpolated between three that do is the same by every
/// way there is.
fn apart() -> Normals {
    [
        leaning(10.0, 60.0),
        leaning(65.0, -10.0),
        leaning(-15.0, -60.0),
        leaning(-60.0, 20.0),
    ]
}

/// How the square is made of polygons.
#[derive(Clone, Copy)]
enum Cut {
    /// One polygon of four corners.
    Whole,
    /// Two triangles that share the diagonal from the dark corner.
    ThroughDark,
    /// Two triangles that share the other one.
    PastDark,
}

/// A square that stands on a corner, turned clockwise by `degrees`. Its normals are not turned: what the light sees of
/// them stays.
fn square(degrees: f64, cut: Cut, normals: Normals) -> Result<Frame, FigureError> {
    let middle = f64::from(SIDE) / 2.0;
    let (sin, cos) = sine_and_cosine(degrees);
    let corner = |x: f64, y: f64, normal| {
        let place = [
            middle + REACH * (cos * x - sin * y),
            middle + REACH * (sin * x + cos * y),
        ];
        Corner::new(place, normal)
    };
    let [above, beside, below, opposite] = normals;
    let [top, right] = [corner(0.0, -1.0, above), corner(1.0, 0.0, beside)];
    let [dark, left] = [corner(0.0, 1.0, below), corner(-1.0, 0.0, opposite)];
    let facets = match cut {
        Cut::Whole => vec![Facet::new([top, right, dark, left])],
        Cut::ThroughDark => vec![
            Facet::new([top, right, dark]),
            Facet::new([top, dark, left]),
        ],
        Cut::PastDark => vec![
            Facet::new([top, right, left]),
            Facet::new([right, dark, left]),
        ],
    };
    frame([SIDE, SIDE], &Grey::dull(DVec3::Z), &facets)
}

/// Exact at quarter turns.
fn sine_and_cosine(degrees: f64) -> (f64, f64) {
    if degrees == 90.0 {
        (1.0, 0.0)
    } else {
        libm::sincos(degrees.to_radians())
    }
}

/// `turned` turned back by `degrees`: the texel that stood there, or one between its neighbours; alpha 0 where one of
/// them is not covered.
fn turned_back(turned: &LinearPicture, degrees: f64) -> LinearPicture {
    let (sin, cos) = sine_and_cosine(degrees);
    let middle = (turned.width() as f64 - 1.0) / 2.0;
    let mut back = LinearPicture::new(turned.width(), turned.height(), [0.0; 4]);
    for y in 0..back.height() {
        for x in 0..back.width() {
            let (dx, dy) = (x as f64 - middle, y as f64 - middle);
            let place = [middle + cos * dx - sin * dy, middle + sin * dx + cos * dy];
            back.row_mut(y)[x] = between(turned, place).unwrap_or([0.0; 4]);
        }
    }
    back
}

/// The texel at `place`, counted in texels from the centre of the first one, linear between the four around it; `None`
/// unless all that count are covered.
fn between(picture: &LinearPicture, place: [f64; 2]) -> Option<[f32; 4]> {
    let along = |at: f64| {
        let first = libm::floor(at + 1e-9);
        let part = (at - first).max(0.0);
        [
            (first, 1.0 - part),
            (first + 1.0, if part < 1e-9 { 0.0 } else { part }),
        ]
    };
    let mut sum = [0.0f64; 3];
    for (y, part_y) in along(place[1]) {
        for (x, part_x) in along(place[0]) {
            let part = part_x * part_y;
            if part == 0.0 {
                continue;
            }
            let is_inside =
                x >= 0.0 && y >= 0.0 && x < picture.width() as f64 && y < picture.height() as f64;
            let texel = is_inside
                .then(|| picture.get(x as usize, y as usize))
                .filter(|texel| texel[3] > 0.0)?;
            for (sum, channel) in sum.iter_mut().zip(texel) {
                *sum += part * f64::from(channel);
            }
        }
    }
    let [r, g, b] = sum.map(|c| c as f32);
    Some([r, g, b, 1.0])
}

/// The largest value of `of` over the pixels that both pictures cover.
fn largest(a: &LinearPicture, b: &LinearPicture, of: impl Fn([f32; 4], [f32; 4]) -> f64) -> f64 {
    let both = a
        .texels()
        .iter()
        .zip(b.texels())
        .filter(|(a, b)| a[3] > 0.0 && b[3] > 0.0);
    both.map(|(a, b)| of(*a, *b)).fold(0.0, f64::max)
}

fn levels(a: [f32; 4], b: [f32; 4]) -> f64 {
    255.0 * f64::from((a[0] - b[0]).abs())
}

/// The angle between two normals that are stored as (N + 1)/2, in degrees.
fn angle(a: [f32; 4], b: [f32; 4]) -> f64 {
    let normal =
        |texel: [f32; 4]| DVec3::from_array([0, 1, 2].map(|i| 2.0 * f64::from(texel[i]) - 1.0));
    let (a, b) = (normal(a), normal(b));
    (2.0 * libm::atan2((a - b).length(), (a + b).length())).to_degrees()
}

/// By how much turning changes what `draw` makes of the square, turned back.
fn change(
    degrees: f64,
    cut: Cut,
    normals: Normals,
    draw: &dyn Fn(&Frame) -> LinearPicture,
    of: fn([f32; 4], [f32; 4]) -> f64,
) -> Result<f64, FigureError> {
    let upright = draw(&square(0.0, cut, normals)?);
    Ok(largest(
        &upright,
        &turned_back(&draw(&square(degrees, cut, normals)?), degrees),
        of,
    ))
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.text(
        "Three corners are white and one is black. At 0° every scan line of the upper half runs between two white edges; \
         turned by 90°, the same half lies between a white edge and one that turns black. The methods interpolate along \
         edges and then along scan lines, so that the colour of a point depends on how its polygon is turned.",
    );
    turns(&mut content, "gouraud", "Gouraud")?;
    turns(&mut content, "naive-phong", "naive Phong")?;
    numbers(&mut content)?;
    directions(&mut content)?;
    diagonals(&mut content)?;
    great_circles(&mut content)?;
    Ok(content)
}

/// A method at 0°, 45° and 90°.
fn turns(content: &mut Content, method: &str, name: &str) -> Result<(), FigureError> {
    let variant = Variant::parse(method)?;
    let mut shown = Vec::new();
    for degrees in [0.0, 45.0, 90.0] {
        let picture = stored(&variant.render_linear(&square(degrees, Cut::Whole, DARK_BELOW)?));
        let alt = format!("The square shaded by {name}, turned by {degrees} degrees.");
        shown.push(Shown::new(format!("{name}, {degrees}°"), alt, picture));
    }
    content.pictures(3, shown);
    Ok(())
}

/// Every method: the square and its triangles, by 45° and by 90°; and both ways to cut.
fn numbers(content: &mut Content) -> Result<(), FigureError> {
    let mut rows = Vec::new();
    for method in METHODS {
        let variant = Variant::parse(method)?;
        let draw = |frame: &Frame| variant.render_linear(frame);
        let whole = |degrees| change(degrees, Cut::Whole, DARK_BELOW, &draw, levels);
        let cut = |degrees| change(degrees, Cut::ThroughDark, apart(), &draw, levels);
        let [square_45, square_90, cut_45, cut_90] =
            [whole(45.0)?, whole(90.0)?, cut(45.0)?, cut(90.0)?];
        let cuts = [Cut::ThroughDark, Cut::PastDark].map(|cut| square(0.0, cut, DARK_BELOW));
        let [one, other] = cuts;
        let diagonal = largest(&draw(&one?), &draw(&other?), levels);
        let numbers = [square_45, square_90, cut_45, cut_90, diagonal].map(written);
        rows.push([vec![method.to_string()], numbers.to_vec()].concat());
        let turns = square_90 > 1.0;
        content.claim(
            format!("square-{method}"),
            format!("{method}, square turned by 90°: largest difference"),
            (square_90, "grey levels"),
            turns,
            [
                "The shading depends on the orientation.",
                "The shading does not depend on it.",
            ],
        );
        // Half a grey level is the least that can be seen in a stored picture.
        let agrees = cut_90 < 0.5;
        content.found(Finding::new(
            format!("triangles-{method}"),
            format!("{method}, triangles turned by 90°: largest difference"),
            (cut_90, "grey levels"),
            Agreement::if_holds(agrees),
            triangles_verdict(agrees),
        ));
        content.claim(
            format!("diagonals-{method}"),
            format!("{method}, one diagonal or the other: largest difference"),
            (diagonal, "grey levels"),
            diagonal > 1.0,
            [
                "Different subdivisions give different pixels.",
                "Both cuts look the same.",
            ],
        );
    }
    content.table(
        &[
            "largest difference in grey levels",
            "square, 45°",
            "square, 90°",
            "triangles, 45°",
            "triangles, 90°",
            "other diagonal",
        ],
        rows,
    );
    content.text(
        "Pictures are turned back and compared where both cover a pixel. A quarter turn takes pixels to pixels; after 45° \
         a pixel lies between four others, and what is read between them smooths the fold at the diagonal: the column of \
         the triangles shows what that alone amounts to. The triangles have four normals that lean by about 60°, each its \
         own way: between normals on one great circle, as those of Figure 5, every way of interpolating is the same.",
    );
    Ok(())
}

fn triangles_verdict(agrees: bool) -> &'static str {
    if agrees {
        "Triangles do not depend on the orientation: rounding is all that is left."
    } else {
        "Triangles depend on the orientation too: great circles are not barycentric."
    }
}

/// The same for the normals themselves.
fn directions(content: &mut Content) -> Result<(), FigureError> {
    let square = change(90.0, Cut::Whole, DARK_BELOW, &normals, angle)?;
    let triangles = change(90.0, Cut::ThroughDark, apart(), &normals, angle)?;
    content.claim(
        "normals-square",
        "interpolated normals, square turned by 90°: largest angle",
        (square, "degrees"),
        square > 1.0,
        [
            "Normals depend on the orientation as intensities do.",
            "Normals agree.",
        ],
    );
    let agrees = triangles < 0.1;
    content.claim(
        "normals-triangles",
        "interpolated normals, triangles turned by 90°: largest angle",
        (triangles, "degrees"),
        agrees,
        [
            "On triangles normals are barycentric as well.",
            "Normals of triangles disagree.",
        ],
    );
    Ok(())
}

/// Two diagonals, two pictures.
fn diagonals(content: &mut Content) -> Result<(), FigureError> {
    let gouraud = Variant::parse("gouraud")?;
    let [one, other] = [
        gouraud.render_linear(&square(0.0, Cut::ThroughDark, DARK_BELOW)?),
        gouraud.render_linear(&square(0.0, Cut::PastDark, DARK_BELOW)?),
    ];
    content.text(
        "Cutting the square into triangles makes it independent of the orientation, and dependent on the diagonal (L21 3).",
    );
    content.pictures(
        3,
        vec![
            Shown::new(
                "Gouraud, cut from top to bottom",
                "Two triangles that meet in the upright diagonal.",
                stored(&one),
            ),
            Shown::new(
                "cut from left to right",
                "Two triangles that meet in the level diagonal; the upper one is all white.",
                stored(&other),
            ),
            Shown::new(
                scale(MAP_SCALES[0]),
                "Both cuts differ most in the middle.",
                difference_map(&one, &other, MAP_SCALES[0])?,
            ),
        ],
    );
    Ok(())
}

/// Slerp on triangles: turned, turned back, compared.
fn great_circles(content: &mut Content) -> Result<(), FigureError> {
    let slerp = Variant::parse("slerp-phong")?;
    let upright = slerp.render_linear(&square(0.0, Cut::ThroughDark, apart())?);
    let turned = turned_back(
        &slerp.render_linear(&square(90.0, Cut::ThroughDark, apart())?),
        90.0,
    );
    let map = difference_map(&upright, &turned, MAP_SCALES[1])?;
    content.text(
        "Interpolation along great circles is not barycentric, so that cutting into triangles does not help it: first \
         along edges and then along scan lines is another normal when the scan lines run the other way.",
    );
    content.pictures(
        3,
        vec![
            Shown::new(
                "slerp Phong, triangles, 0°",
                "The triangles shaded by slerp Phong.",
                stored(&upright),
            ),
            Shown::new(
                "90°, turned back",
                "The same, drawn when turned by 90 degrees and turned back.",
                stored(&turned),
            ),
            Shown::new(
                scale(MAP_SCALES[1]),
                "Where both differ: over the whole of both triangles.",
                map,
            ),
        ],
    );
    Ok(())
}

fn scale(levels: f32) -> String {
    format!(
        "their difference: purple to yellow is up to {levels} grey levels, black none, magenta more"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_back_undoes_a_quarter_turn_to_the_bit() {
        // Row 0 of the turned picture, left to right, is the left column of the original, upward.
        let texel = |n: usize| [n as f32 / 9.0, 0.0, 0.0, 1.0];
        let upright =
            LinearPicture::from_texels(3, 3, (0..9).map(texel).collect()).expect("nine texels");
        let turned = [6, 3, 0, 7, 4, 1, 8, 5, 2].map(texel).to_vec();
        let turned = LinearPicture::from_texels(3, 3, turned).expect("nine texels");
        assert_eq!(turned_back(&turned, 90.0), upright);
    }

    #[test]
    fn what_lies_between_texels_is_linear_and_needs_all_of_them() {
        let mut picture = LinearPicture::new(2, 2, [0.0, 0.0, 0.0, 1.0]);
        picture.row_mut(0)[1] = [1.0, 0.5, 0.0, 1.0];
        assert_eq!(
            between(&picture, [0.25, 0.5]),
            Some([0.125, 0.0625, 0.0, 1.0])
        );
        assert_eq!(between(&picture, [1.0, 0.0]), Some([1.0, 0.5, 0.0, 1.0]));
        assert_eq!(between(&picture, [1.5, 0.0]), None);
        picture.row_mut(1)[0][3] = 0.0;
        assert_eq!(between(&picture, [0.25, 0.5]), None);
        assert!(
            between(&picture, [0.25, 0.0]).is_some(),
            "a row that does not count need not be covered"
        );
    }
}
