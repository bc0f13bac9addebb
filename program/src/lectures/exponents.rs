//! The exponent of the highlight: powers of the cosine, spheres for k_s and p, and N·H against R·V
//! (L5; CS171 2, Figure 7).

use super::prelude::*;

pub(super) static FIGURE: Figure = Figure {
    name: "exponents",
    title: "The exponent and the size of the highlight",
    lecture: "L5, Cosine power plots; CS171 2, Figures 7 and 8",
    parts: &[powers, grid, half_vector],
    live: None,
};

const EXPONENTS: [f32; 5] = [1.0, 8.0, 32.0, 128.0, 512.0];
const STRENGTHS: [f32; 3] = [0.25, 0.5, 0.75];
/// Half of the visible height, in radii of the sphere.
const HALF_HEIGHT: f64 = 1.1;

/// Returns the angle at which cos^p has fallen to a half, in degrees.
fn half_width(p: f64) -> f64 {
    libm::acos(libm::pow(0.5, 1.0 / p)).to_degrees()
}

fn powers(content: &mut FigureContent) -> Result {
    let curve = |p: f32| {
        let power = |degrees: f64| libm::pow(libm::cos(degrees.to_radians()).max(0.0), p.into());
        Series::sampled(format!("p = {p}"), (0..=90).map(f64::from), power)
    };
    let [widest, narrowest] = [1.0, 512.0].map(half_width);
    let [wide, narrow] = [widest, narrowest].map(written);
    content.plot(Plot::new(
        "Cosine powers",
        ["angle between R and V, degrees", "highlight"].map(linear),
        EXPONENTS.map(curve),
        format!("The curve has fallen to half its height at {wide}° for p = 1 and at {narrow}° for p = 512."),
    ));
    let widths = EXPONENTS.map(|p| half_width(p.into()));
    content.confirms(
        "narrows | half width at p = 1 over that at p = 512",
        (widest / narrowest, "", widths.is_sorted_by(|a, b| a > b)),
        "Increasing p narrows the lobe.",
    );
    Ok(())
}

/// Draws a scene with the highlights of `specular`. Its exponents are meant for `specular`, too, so
/// that nothing converts them.
fn drawn(mut scene: Scene, specular: SpecularModel) -> Result<LinearPicture> {
    (scene.specular, scene.shininess_for) = (specular, specular);
    draw(&scene.frame()?, "naive-phong")
}

/// Makes a sphere with a highlight and a little diffuse light.
fn shiny(strength: f32, exponent: f32, light: DVec3, side: u32) -> Result<Scene> {
    let material = grey(0.02, 0.2, strength, exponent);
    let spec = "sphere?rings=32&segments=64";
    scene(spec, material, light, HALF_HEIGHT, [side; 2])
}

/// Draws the grid of the lecture, k_s downward and p to the right.
fn grid(content: &mut FigureContent) -> Result {
    let light = DVec3::new(-0.4, 0.5, 0.8);
    let (mut panels, mut bright) = (Vec::new(), Vec::new());
    for strength in STRENGTHS {
        for exponent in EXPONENTS {
            let sphere = shiny(strength, exponent, light, 56)?;
            let picture = drawn(sphere, SpecularModel::Phong)?;
            // Ambient and diffuse light together are at most 0.22: the highlight is where it adds
            // more than half of its strength.
            bright.push(share(&picture, |pixel| pixel[0] > 0.22 + strength / 2.0));
            panels.push((format!("k_s {strength}, p {exponent}"), stored(&picture)));
        }
    }
    content.text("The strength k_s grows from top to bottom, the exponent p from left to right.");
    content.pictures(EXPONENTS.len(), "A sphere with a highlight", panels);
    let strongest = &bright[2 * EXPONENTS.len()..];
    let (matte, shiny) = (strongest[0], strongest[3]);
    let (low, high) = (EXPONENTS[0], EXPONENTS[3]);
    content.contradicts(
        &format!("shiny | share of the sphere in the highlight, p = {low} over p = {high}"),
        (matte / shiny.max(1e-4), "", matte >= shiny),
        "Very shiny surfaces have a large p, as Figure 7 of CS171 shows. The text of CS171 says that p is \
         close to 1.",
    );
    Ok(())
}

/// Measures the half width of a highlight without other light, in degrees of the normal, on the
/// middle row of a sphere lit from the eye. Also returns the curve, as angles and intensities.
fn measured(exponent: f32, specular: SpecularModel) -> Result<(f64, Vec<(f64, f64)>)> {
    const SIDE: u32 = 481;
    // The picture has the three middle rows of a square one. Its middle row passes through the
    // middle of the sphere.
    let half_height = 3.0 * HALF_HEIGHT / f64::from(SIDE);
    let material = grey(0.0, 0.0, 1.0, exponent);
    let spec = "sphere?rings=96&segments=192";
    let sphere = scene(spec, material, DVec3::Z, half_height, [SIDE, 3])?;
    let picture = drawn(sphere, specular)?;
    let degrees = |x: f64| {
        let across = 2.0 * HALF_HEIGHT * (x + 0.5 - f64::from(SIDE) / 2.0) / f64::from(SIDE);
        libm::asin(across.clamp(-1.0, 1.0)).to_degrees()
    };
    let row = picture.row(1);
    let points: Vec<(f64, f64)> = (SIDE as usize / 2..SIDE as usize)
        .filter(|&x| row[x][3] > 0.0)
        .map(|x| (degrees(x as f64), f64::from(row[x][0])))
        .collect();
    // Interpolate between the last pixel that has a half or more and the next one.
    let last = points.iter().rposition(|p| p.1 >= 0.5).unwrap_or(0);
    let (a, b) = (points[last], points[(last + 1).min(points.len() - 1)]);
    let part = if a.1 > b.1 {
        (a.1 - 0.5) / (a.1 - b.1)
    } else {
        0.0
    };
    Ok((a.0 + part * (b.0 - a.0), points))
}

/// Compares R·V with N·H at the same exponent, and at four times the exponent.
fn half_vector(content: &mut FigureContent) -> Result {
    let (mut widths, mut curves, mut panels) = (Vec::new(), Vec::new(), Vec::new());
    for (label, exponent, specular) in [
        ("R·V, p = 20", 20.0, SpecularModel::Phong),
        ("N·H, p = 20", 20.0, SpecularModel::Blinn),
        ("N·H, p = 80", 80.0, SpecularModel::Blinn),
    ] {
        let (width, points) = measured(exponent, specular)?;
        widths.push(width);
        let points = points.into_iter().filter(|p| p.0 < 60.0).step_by(3);
        curves.push(Series::new(label, points));
        let picture = drawn(shiny(0.75, exponent, DVec3::Z, 80)?, specular)?;
        panels.push((label, stored(&picture)));
    }
    content.text(
        "The angle between N and H is half the angle between R and V, so the same exponent makes a wider \
         highlight.",
    );
    content.pictures(3, "A sphere with a highlight", panels);
    content.plot(Plot::new(
        "The highlight along the equator of the sphere, lit from the eye",
        [linear("angle of the normal, degrees"), linear("highlight")],
        curves,
        "R·V, N·H with the same exponent, and N·H with four times the exponent.",
    ));
    let [phong, same, converted] = [0, 1, 2].map(|i| widths[i]);
    // The angle is half as large, so the width doubles as far as cos^p is a Gauss curve.
    content.contradicts(
        "same-exponent | half width of N·H over that of R·V, same exponent",
        (same / phong, "", same / phong > 1.5),
        "CS171 says that the angle at H \"can also be used\". That is not so with the same exponent.",
    );
    let ratio = converted / phong;
    content.adds(
        "converted | half width of N·H with four times the exponent, over that of R·V",
        (ratio, "", (ratio - 1.0).abs() < 0.05),
        "Four times the exponent makes up for it.",
    );
    let expected = half_width(20.0) / 2.0;
    content.adds(
        "half-width | half width of R·V for p = 20 on the sphere",
        (phong, "degrees", (phong - expected).abs() < 0.1),
        "It is half of the half width of cos^20, because the normal turns half as fast as R.",
    );
    Ok(())
}
