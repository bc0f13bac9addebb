//! The square of Figure 5: its shading changes when one turns it or cuts it into triangles (L21 3).

use super::prelude::*;
use fastphong::raster::normals;

pub(super) static FIGURE: Figure = Figure {
    name: "square",
    title: "The square that changes when it is turned",
    lecture: "L21 3, Figure 5; L21 4.1",
    parts: &[turns, compare_methods, directions, diagonals, great_circles],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "The shading of a polygon changes when it is turned, because edges and scan lines then interpolate between other pairs of corners (L21 3, Figure 5; 4.1).",
    handles: &[
        Handle::slider(["turn", "turn of the square", "°"], [0.0, 90.0], 1.0, 30.0),
        Handle::slider(
            ["corners", "corners of its polygons", ""],
            [3.0, 4.0],
            1.0,
            4.0,
        ),
    ],
    make: turned,
};

/// Width and height of the pictures.
const SIDE: u32 = 120;
/// The distance from the middle to a corner, in pixels. With it no edge or diagonal meets a pixel
/// centre at 0° and 90°.
const REACH: f64 = 56.25;
/// Grey levels at the yellow end of the difference maps, of the two diagonals and of turned
/// triangles.
const MAP_SCALES: [f32; 2] = [128.0, 40.0];
/// The methods that are turned.
const METHODS: [&str; 4] = ["gouraud", "naive-phong", "fast-phong", "slerp-phong"];

/// The unit normals of the corners: top, right, bottom, left, when the square stands at 0°.
type Normals = [DVec3; 4];

/// The normals of Figure 5: three face the light, and the lowest corner's is at a right angle to
/// it.
const DARK_BELOW: Normals = [DVec3::Z, DVec3::Z, DVec3::NEG_Y, DVec3::Z];

/// Returns normals of which no three lie on one great circle. If three do, all ways to interpolate
/// between them agree.
fn apart() -> Normals {
    let leaning = |right: f64, up: f64| {
        let [x, y] = [right, up].map(|degrees| libm::tan(degrees.to_radians()));
        DVec3::new(x, y, 1.0).normalize()
    };
    [
        leaning(10.0, 60.0),
        leaning(65.0, -10.0),
        leaning(-15.0, -60.0),
        leaning(-60.0, 20.0),
    ]
}

/// The polygons of the square, as indices of their corners.
type Polygons = &'static [&'static [usize]];
const WHOLE: Polygons = &[&[0, 1, 2, 3]];
/// Two triangles that share the diagonal from the dark corner.
const THROUGH_DARK: Polygons = &[&[0, 1, 2], &[0, 2, 3]];
/// Two triangles that share the other diagonal.
const PAST_DARK: Polygons = &[&[0, 1, 3], &[1, 2, 3]];

/// Makes a square that stands on a corner, turned clockwise by `degrees`. Its normals do not turn,
/// so that the corners keep their light.
fn square(degrees: f64, polygons: Polygons, normals: Normals) -> Result<Frame> {
    let middle = f64::from(SIDE) / 2.0;
    let (sin, cos) = sine_and_cosine(degrees);
    let places = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]
        .map(|(x, y)| [cos * x - sin * y, sin * x + cos * y]);
    let corner = |i: &usize| ScreenCorner::new(places[*i].map(|c| middle + REACH * c), normals[*i]);
    let polygon =
        |corners: &&[usize]| ScreenPolygon::new(corners.iter().map(corner).collect::<Vec<_>>());
    let polygons: Vec<_> = polygons.iter().map(polygon).collect();
    frame([SIDE; 2], DULL, DVec3::Z, &polygons)
}

/// Returns sine and cosine, exact at quarter turns.
fn sine_and_cosine(degrees: f64) -> (f64, f64) {
    match degrees {
        90.0 => (1.0, 0.0),
        _ => libm::sincos(degrees.to_radians()),
    }
}

/// Turns `turned` back by `degrees`. Each pixel is interpolated from the four around its place, or
/// has alpha 0 if one of them is not covered.
fn turned_back(turned: &LinearPicture, degrees: f64) -> LinearPicture {
    let (sin, cos) = sine_and_cosine(degrees);
    let middle = (turned.width() as f64 - 1.0) / 2.0;
    let mut back = LinearPicture::new(turned.width(), turned.height(), [0.0; 4]);
    for y in 0..back.height() {
        for x in 0..back.width() {
            let (dx, dy) = (x as f64 - middle, y as f64 - middle);
            let position = [middle + cos * dx - sin * dy, middle + sin * dx + cos * dy];
            back.row_mut(y)[x] = between(turned, position).unwrap_or([0.0; 4]);
        }
    }
    back
}

/// Interpolates the colour at `position` from the four pixels around it. The position is in pixels
/// from the centre of the first one. Returns `None` if a pixel with a weight is not covered.
fn between(picture: &LinearPicture, position: [f64; 2]) -> Option<[f32; 4]> {
    let along = |at: f64| {
        // Sines and cosines round: a position that is meant to be a pixel's centre may lie just
        // before it.
        let first = libm::floor(at + 1e-9);
        let part = (at - first).max(0.0);
        [
            (first, 1.0 - part),
            (first + 1.0, if part < 1e-9 { 0.0 } else { part }),
        ]
    };
    let mut sum = DVec3::ZERO;
    for (y, part_y) in along(position[1]) {
        for (x, part_x) in along(position[0]) {
            let part = part_x * part_y;
            if part == 0.0 {
                continue;
            }
            let is_inside =
                x >= 0.0 && y >= 0.0 && x < picture.width() as f64 && y < picture.height() as f64;
            let pixel = is_inside
                .then(|| picture.get(x as usize, y as usize))
                .filter(|pixel| pixel[3] > 0.0)?;
            let [r, g, b, _] = pixel.map(f64::from);
            sum += part * DVec3::new(r, g, b);
        }
    }
    Some(sum.as_vec3().extend(1.0).to_array())
}

/// Returns the largest angle between the normals of two pictures, in degrees. The pictures store
/// normals as (N + 1)/2.
fn angles(a: &LinearPicture, b: &LinearPicture) -> f64 {
    let normal =
        |pixel: [f32; 4]| DVec3::from_array([0, 1, 2].map(|i| 2.0 * f64::from(pixel[i]) - 1.0));
    largest(covered_by_both(a, b).map(|(a, b)| angle(normal(a), normal(b))))
}

/// Draws the square twice: at 0°, and turned by `degrees`, whose picture is then turned back.
fn turned_both_ways(
    degrees: f64,
    polygons: Polygons,
    normals: Normals,
    draw: impl Fn(&Frame) -> Result<LinearPicture>,
) -> Result<[LinearPicture; 2]> {
    let upright = draw(&square(0.0, polygons, normals)?)?;
    let turned = draw(&square(degrees, polygons, normals)?)?;
    Ok([upright, turned_back(&turned, degrees)])
}

/// Draws the square cut along either diagonal.
fn both_cuts(method: &str) -> Result<[LinearPicture; 2]> {
    let through = draw(&square(0.0, THROUGH_DARK, DARK_BELOW)?, method)?;
    let past = draw(&square(0.0, PAST_DARK, DARK_BELOW)?, method)?;
    Ok([through, past])
}

fn turns(content: &mut FigureContent) -> Result {
    content.text(
        "Three corners are white and one is black. At 0° every scan line of the upper half runs between \
         two white edges. At 90° one of them goes from white to black. The methods interpolate along \
         edges, then along scan lines, so the colour of a point depends on the orientation.",
    );
    for (method, name) in [("gouraud", "Gouraud"), ("naive-phong", "naive Phong")] {
        let mut panels = Vec::new();
        for degrees in [0.0, 45.0, 90.0] {
            let picture = draw(&square(degrees, WHOLE, DARK_BELOW)?, method)?;
            panels.push((format!("{name}, {degrees}°"), stored(&picture)));
        }
        content.pictures(3, "The square", panels);
    }
    Ok(())
}

/// Shows the square turned, whole or as two triangles, and measures how its shading changes.
fn turned(content: &mut FigureContent, values: &[f64]) -> Result {
    let degrees = values[0];
    let polygons = if values[1] < 4.0 { THROUGH_DARK } else { WHOLE };
    let mut panels = Vec::new();
    for (method, name) in [("gouraud", "Gouraud"), ("naive-phong", "naive Phong")] {
        let picture = draw(&square(degrees, polygons, DARK_BELOW)?, method)?;
        panels.push((format!("{name}, {degrees}°"), stored(&picture)));
        let pictures =
            turned_both_ways(degrees, polygons, DARK_BELOW, |frame| draw(frame, method))?;
        let change = levels(&pictures[0], &pictures[1]);
        match polygons.len() {
            1 if change > 1.0 => depends(content, method, degrees, change),
            1 => content.adds(
                &format!(
                    "square-{method} | {method}, square turned by {degrees}°: largest difference"
                ),
                (change, "grey levels", true),
                "It changes by less than a grey level: turn it further.",
            ),
            _ => depends_not(content, method, degrees, change),
        }
    }
    content.pictures(2, "The square", panels);
    Ok(())
}

/// Adds the finding of how far turned triangles change, in grey levels.
fn depends_not(content: &mut FigureContent, method: &str, degrees: f64, change: f64) {
    // Half a grey level is the least that can be seen in a stored picture.
    let agrees = change < 0.5;
    content.found(
        &format!(
            "triangles-{method} | {method}, triangles turned by {degrees}°: largest difference"
        ),
        (change, "grey levels", true),
        Agreement::if_holds(agrees),
        if agrees {
            "Triangles do not depend on the orientation: only rounding is left."
        } else {
            "Triangles depend on the orientation, too: great circles are not barycentric."
        },
    );
}

/// Adds the finding of how far a turned square changes, in grey levels.
fn depends(content: &mut FigureContent, method: &str, degrees: f64, change: f64) {
    content.confirms(
        &format!("square-{method} | {method}, square turned by {degrees}°: largest difference"),
        (change, "grey levels", change > 1.0),
        "The shading depends on the orientation.",
    );
}

/// Measures for every method how far the square and its triangles change when they turn by 45° and
/// 90°, and how far the two cuts differ.
fn compare_methods(content: &mut FigureContent) -> Result {
    let mut rows = Vec::new();
    for method in METHODS {
        let change = |degrees, polygons, normals| {
            let pictures =
                turned_both_ways(degrees, polygons, normals, |frame| draw(frame, method));
            pictures.map(|[upright, back]| levels(&upright, &back))
        };
        let square_45 = change(45.0, WHOLE, DARK_BELOW)?;
        let square_90 = change(90.0, WHOLE, DARK_BELOW)?;
        let triangles_45 = change(45.0, THROUGH_DARK, apart())?;
        let triangles_90 = change(90.0, THROUGH_DARK, apart())?;
        let [through, past] = both_cuts(method)?;
        let diagonal = levels(&through, &past);
        let cells = [square_45, square_90, triangles_45, triangles_90, diagonal].map(written);
        rows.push(format!("{method} | {}", cells.join(" | ")));
        depends(content, method, 90.0, square_90);
        depends_not(content, method, 90.0, triangles_90);
        content.confirms(
            &format!(
                "diagonals-{method} | {method}, one diagonal against the other: largest difference"
            ),
            (diagonal, "grey levels", diagonal > 1.0),
            "Different subdivisions have different pixels.",
        );
    }
    content.table(
        "largest difference in grey levels | square, 45° | square, 90° | triangles, 45° \
         | triangles, 90° | other diagonal",
        rows,
    );
    content.text(
        "Each picture is turned back and compared. At 45° that needs resampling, which blurs the fold at \
         the diagonal a little: the columns of the triangles show by how much. \
         Their four normals lean by about 60°, each in another direction. In Figure 5 they lie on one \
         great circle, and there all methods interpolate alike.",
    );
    Ok(())
}

/// Compares the interpolated normals themselves.
fn directions(content: &mut FigureContent) -> Result {
    let change = |polygons, normals_at| {
        let pictures = turned_both_ways(90.0, polygons, normals_at, |frame| Ok(normals(frame)));
        pictures.map(|[upright, back]| angles(&upright, &back))
    };
    let square = change(WHOLE, DARK_BELOW)?;
    content.confirms(
        "normals-square | interpolated normals, square turned by 90°: largest angle",
        (square, "degrees", square > 1.0),
        "Like intensities, normals depend on the orientation.",
    );
    let triangles = change(THROUGH_DARK, apart())?;
    content.confirms(
        "normals-triangles | interpolated normals, triangles turned by 90°: largest angle",
        (triangles, "degrees", triangles < 0.1),
        "On triangles normals are barycentric, too.",
    );
    Ok(())
}

/// Compares the square cut along either diagonal.
fn diagonals(content: &mut FigureContent) -> Result {
    content.text(
        "When the square is cut into triangles, its shading depends on the diagonal instead of the \
         orientation (L21 3).",
    );
    content.compared(
        "The square of two triangles",
        "Gouraud, cut from top to bottom | cut from left to right",
        &both_cuts("gouraud")?,
        MAP_SCALES[0],
    )
}

/// Compares triangles by slerp Phong at 0° with triangles turned by 90°.
fn great_circles(content: &mut FigureContent) -> Result {
    content.text(
        "Interpolation along great circles is not barycentric: it depends on the orientation even on \
         triangles.",
    );
    let slerp = |frame: &Frame| draw(frame, "slerp-phong");
    content.compared(
        "The triangles by slerp Phong",
        "slerp Phong, triangles, 0° | 90°, turned back",
        &turned_both_ways(90.0, THROUGH_DARK, apart(), slerp)?,
        MAP_SCALES[1],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_back_undoes_a_quarter_turn_to_the_bit() {
        // Row 0 of the turned picture, left to right, is the left column of the original, upward.
        let pixel = |n: usize| [n as f32 / 9.0, 0.0, 0.0, 1.0];
        let upright =
            LinearPicture::from_pixels(3, 3, (0..9).map(pixel).collect()).expect("nine pixels");
        let turned = [6, 3, 0, 7, 4, 1, 8, 5, 2].map(pixel).to_vec();
        let turned = LinearPicture::from_pixels(3, 3, turned).expect("nine pixels");
        assert_eq!(turned_back(&turned, 90.0), upright);
    }

    #[test]
    fn a_position_between_pixels_is_linear_and_needs_all_of_them() {
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
