//! Ambient, diffuse and specular light, each on its own and summed (L5, L21 2.1), and Lambert's law
//! on a turning cube.

use super::prelude::*;
use fastphong::raster::polygon_indices;

pub(super) static FIGURE: Figure = Figure {
    name: "illumination",
    title: "Ambient, diffuse and specular light",
    lecture: "L21 2.1; L5, Phong reflection, Lambert's cosine law; CS171 2",
    parts: &[terms, diffuse_series, cube],
    live: None,
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [96, 96];
const LIGHT: DVec3 = DVec3::new(-0.5, 0.6, 0.7);

fn sphere(material: Material) -> Result<LinearPicture> {
    let scene = scene("sphere?rings=24&segments=48", material, LIGHT, 1.1, SIZE)?;
    draw(&scene.frame()?, "naive-phong")
}

/// Draws the three terms of 2.1, and their sum.
fn terms(content: &mut FigureContent) -> Result {
    // Together at most 1, so that nothing is clamped.
    let ambient = sphere(grey(0.12, 0.0, 0.0, 30.0))?;
    let diffuse = sphere(grey(0.0, 0.5, 0.0, 30.0))?;
    let specular = sphere(grey(0.0, 0.0, 0.38, 30.0))?;
    let all = sphere(grey(0.12, 0.5, 0.38, 30.0))?;
    content.text(
        "The three terms of equation 2.1 on one sphere in one light: each on its own, and all together.",
    );
    content.row(
        "A sphere",
        "ambient | diffuse | specular | all three",
        [&ambient, &diffuse, &specular, &all].map(stored),
    );
    let mut sum = ambient;
    let others = diffuse.pixels().iter().zip(specular.pixels());
    for (pixel, (d, s)) in sum.pixels_mut().iter_mut().zip(others) {
        (0..3).for_each(|c| pixel[c] += d[c] + s[c]);
    }
    let difference = levels(&sum, &all);
    content.confirms(
        "sum | sum of the three pictures against one with all terms, largest difference",
        (difference, "grey levels", difference < 0.01),
        "Apart from rounding the terms add up.",
    );
    Ok(())
}

/// Draws only diffuse light, for growing k_d.
fn diffuse_series(content: &mut FigureContent) -> Result {
    let (mut panels, mut ratios) = (Vec::new(), Vec::new());
    for kd in [0.25f32, 0.5, 0.75, 1.0] {
        let picture = sphere(grey(0.0, kd, 0.0, 1.0))?;
        let pixels = picture.pixels().iter();
        ratios.push(pixels.fold(0.0, |most, pixel| pixel[0].max(most)) / kd);
        panels.push((format!("k_d = {kd}"), stored(&picture)));
    }
    content.pictures(4, "A sphere in diffuse light", panels);
    let change = |ratio: &f32| f64::from((ratio / ratios[0] - 1.0).abs());
    let change = largest(ratios.iter().map(change));
    content.confirms(
        "kd | brightest pixel over k_d: largest relative change along the series",
        (change, "", change < 1e-6),
        "Diffuse light is proportional to k_d.",
    );
    Ok(())
}

/// Makes the lecture's cube under light from above, turned clockwise by `degrees` around the z
/// axis.
fn turned(degrees: f64) -> Result<Frame> {
    let mut cube = scene("cube", DULL, DVec3::Y, 2.4, SIZE)?;
    // The camera looks from the right and from above, which shows the top at every angle. The grey
    // background shows unlit faces.
    cube.camera.eye = DVec3::new(2.8, 2.2, 3.4);
    cube.background = [0.3; 3];
    cube.objects[0].normals = NormalSource::Crease(30.0).into();
    cube.objects[0].transform = DAffine3::from_rotation_z(-degrees.to_radians());
    Ok(cube.frame()?)
}

/// Returns the intensity of the face that was on top before the cube turned; `None` if no pixel
/// shows it.
fn top(frame: &Frame, picture: &LinearPicture, degrees: f64) -> Option<f64> {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let up = DVec3::new(sin, cos, 0.0);
    let is_top = |number: &u32| {
        let polygon = frame.polygons().get(*number as usize);
        let normal = polygon.map(|p| DVec3::from_array(frame.polygon_normal(p).map(f64::from)));
        normal.is_some_and(|normal| normal.dot(up) > 0.999)
    };
    let pixel = polygon_indices(frame).pixels().iter().position(is_top)?;
    Some(f64::from(picture.pixels()[pixel][0]))
}

/// Turns a cube under light from above, and measures its top (L5: "top face of 60° rotated cube
/// intercepts half the light").
fn cube(content: &mut FigureContent) -> Result {
    let (mut measured, mut panels) = (Vec::new(), Vec::new());
    for degrees in [0.0, 15.0, 30.0, 45.0, 60.0, 75.0] {
        let frame = turned(degrees)?;
        let picture = draw(&frame, "flat")?;
        measured.extend(top(&frame, &picture, degrees).map(|light| (degrees, light)));
        if degrees == 0.0 || degrees == 60.0 {
            panels.push((format!("turned by {degrees}°"), stored(&picture)));
        }
    }
    content.text(
        "Lambert's law: the top face receives light in proportion to the cosine of the angle by which it \
         is turned.",
    );
    content.pictures(2, "A cube under light from above", panels);
    let cosine = |degrees: f64| libm::cos(degrees.to_radians());
    let angles = (0..=15).map(|i| 5.0 * f64::from(i));
    content.plot(Plot::new(
        "Light on the face that was on top",
        [linear("angle, degrees"), linear("intensity")],
        [
            Series::new("measured on the picture", measured.iter().copied()),
            Series::sampled("cosine", angles, cosine),
        ],
        "The points are measured on the picture. The curve is the cosine.",
    ));
    let at = |degrees| measured.iter().find(|(turn, _)| *turn == degrees);
    let [half, whole] = [60.0, 0.0].map(|degrees| at(degrees).map_or(f64::NAN, |m| m.1));
    let ratio = half / whole;
    content.confirms(
        "cube | light on the top face at 60°, over that at 0°",
        (ratio, "", (ratio - 0.5).abs() < 1e-6),
        "Half the light, as the lecture says.",
    );
    let error = |(degrees, light): &(f64, f64)| (light - cosine(*degrees)).abs();
    let (count, worst) = (measured.len(), largest(measured.iter().map(error)));
    content.confirms(
        &format!("cosine | largest distance from the cosine at {count} angles"),
        (worst, "", worst < 1e-6),
        &format!(
            "The cosine law holds, apart from rounding ({}).",
            written(worst)
        ),
    );
    Ok(())
}
