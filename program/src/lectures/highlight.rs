//! Where Gouraud shading loses the highlight: the size of polygons and the size of the highlight
//! (L21 4).

use super::prelude::*;

pub(super) static FIGURE: Figure = Figure {
    name: "highlight",
    title: "Where Gouraud loses the highlight",
    lecture: "L21 4: \"blurring these intensities also blurs specular reflections\"",
    parts: &[sizes],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "\u{201c}Blurring these intensities also blurs specular reflections\u{201d} (L21 4): between vertices each pixel is the previous one plus ΔI (3.6).",
    handles: &[
        Handle::slider(
            ["cells", "polygons around the sphere", ""],
            [8.0, 96.0],
            2.0,
            20.0,
        ),
        Handle::slider(["exponent", "exponent n", ""], [2.0, 200.0], 2.0, 60.0),
    ],
    make: |content, values| {
        let (cells, exponent) = (values[0] as u32, values[1] as f32);
        let [gouraud, naive] = drawn(cells, exponent)?;
        let kept = kept(&gouraud, &naive);
        content.row(
            "A sphere whose highlight lies in the middle of a polygon",
            "Gouraud | naive Phong",
            [&gouraud, &naive].map(stored),
        );
        let middle = SIDE as usize / 2;
        let row = |(name, picture): (&str, &LinearPicture)| {
            let row = profile(picture, middle).into_iter().enumerate();
            Series::new(name, row.map(|(x, level)| (x as f64 + 0.5, level)))
        };
        content.plot(Plot::new(
            "Intensity along the middle row",
            [linear("column, pixels"), linear("intensity, grey levels")],
            [("Gouraud", &gouraud), ("naive Phong", &naive)].map(row),
            "Between vertices, Gouraud's intensity cannot rise above theirs.",
        ));
        loses(content, "kept", cells, exponent, kept);
        Ok(())
    },
};

/// Width and height of the pictures.
const SIDE: u32 = 160;
/// How many polygons go around the spheres; half as many go from pole to pole.
const CELLS: [u32; 5] = [8, 16, 24, 48, 96];
const EXPONENTS: [f32; 4] = [4.0, 16.0, 64.0, 200.0];
const DIFFUSE: f32 = 0.3;
const AMBIENT: f32 = 0.04;

/// Draws a sphere lit from the eye, by Gouraud and by naive Phong. It is turned so that the middle
/// of a polygon beside the equator faces the eye: no other place loses as much.
fn drawn(cells: u32, exponent: f32) -> Result<[LinearPicture; 2]> {
    let mesh = format!("sphere?segments={cells}&rings={}", cells / 2);
    let material = grey(AMBIENT, DIFFUSE, 0.6, exponent);
    let mut scene = scene(&mesh, material, DVec3::Z, 1.05, [SIDE; 2])?;
    let half_cell = core::f64::consts::PI / f64::from(cells);
    // With an even count of bands a ring of corners lies on the equator: turn it by half a band.
    // With an odd count the middle of a band is there already.
    let up = if (cells / 2).is_multiple_of(2) {
        half_cell
    } else {
        0.0
    };
    // Corners stand at multiples of a cell from the x axis. If a quarter turn is one of them, a
    // corner faces the eye.
    let aside = if cells.is_multiple_of(4) {
        half_cell
    } else {
        0.0
    };
    scene.objects[0].transform = DAffine3::from_rotation_x(up) * DAffine3::from_rotation_y(aside);
    draw_each(&scene.frame()?, ["gouraud", "naive-phong"])
}

/// Returns how much of the highlight's height over the diffuse light Gouraud keeps, from 0 to 1.
fn kept(gouraud: &LinearPicture, naive: &LinearPicture) -> f64 {
    let middle = SIDE as usize / 2;
    // Light, eye and normal agree in the middle, so that ambient and diffuse light have their full
    // strength.
    let dull = f64::from(AMBIENT + DIFFUSE);
    let height = |picture: &LinearPicture| f64::from(picture.get(middle, middle)[0]) - dull;
    (height(gouraud) / height(naive)).clamp(0.0, 1.0)
}

/// Returns how wide the part of the surface is where the highlight has at least half of its height,
/// in degrees. The normal turns half as fast as R, and the highlight has two sides, so that the
/// factors cancel.
fn width(exponent: f32) -> f64 {
    libm::acos(libm::pow(0.5, 1.0 / f64::from(exponent))).to_degrees()
}

/// Adds the finding of the part of the highlight that Gouraud keeps, from 0 to 1.
fn loses(content: &mut FigureContent, key: &str, cells: u32, exponent: f32, kept: f64) {
    let degrees = 360.0 / f64::from(cells);
    let (wide, cell) = (written(width(exponent)), written(degrees));
    let is_lost = kept < 0.9;
    let facts = format!("The highlight is {wide}° wide, a polygon {cell}°.");
    let says = if kept < 0.1 {
        "No vertex sees it, so nothing between the vertices can."
    } else if is_lost {
        "The vertices see less of it, and nothing between them is brighter than they are."
    } else {
        "The polygons are small compared with the highlight: Gouraud is a cheaper Phong."
    };
    let agreement = if is_lost {
        Agreement::Confirms
    } else {
        Agreement::Adds
    };
    content.found(
        &format!("{key} | part of the highlight's height that Gouraud keeps in the middle of a polygon, {cells} around, n = {exponent}"),
        (100.0 * kept, "%", true),
        agreement,
        &format!("{facts} {says}"),
    );
}

/// Measures which part Gouraud keeps, for several sizes of polygons and exponents.
fn sizes(content: &mut FigureContent) -> Result {
    content.text(
        "A sphere lit from the eye, turned so that the highlight falls into the middle of a polygon. \
         There Gouraud loses most of it. Turn the sphere by half a polygon: now a vertex stands there \
         and keeps all of it. So the highlight flickers when the model turns.",
    );
    let mut rows = Vec::new();
    let mut worst = Vec::new();
    for exponent in EXPONENTS {
        let mut row = format!("{exponent} ({}°)", written(width(exponent)));
        for cells in CELLS {
            let [gouraud, naive] = drawn(cells, exponent)?;
            let kept = kept(&gouraud, &naive);
            row += &format!(" | {:.0} %", 100.0 * kept);
            worst.push((exponent, cells, kept));
        }
        rows.push(row);
    }
    let cells = CELLS.map(|cells| format!(" | {}°", written(360.0 / f64::from(cells))));
    let head = format!(
        "exponent (width): height that is kept, by the angle of a polygon{}",
        cells.concat()
    );
    content.table(&head, rows);
    let [gouraud, naive] = drawn(20, 60.0)?;
    content.row(
        "A sphere of 20 polygons around, n = 60",
        "Gouraud | naive Phong",
        [&gouraud, &naive].map(stored),
    );
    for (key, exponent, cells) in [("coarse", 64.0, 16), ("fine", 64.0, 96), ("dull", 4.0, 48)] {
        let found = worst.iter().find(|w| w.0 == exponent && w.1 == cells);
        if let Some((exponent, cells, kept)) = found {
            loses(content, key, *cells, *exponent, *kept);
        }
    }
    Ok(())
}
