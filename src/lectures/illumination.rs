//! Ambient, diffuse and specular light apart and summed (L5, L21 2.1), and Lambert's law on a cube that turns.

use super::lit::{drawn, grey, levels, scene, shown};
use super::stage::written;
use super::{Content, Figure, FigureError, Plot, Scale, Series};
use crate::frame::Frame;
use crate::mesh::Material;
use crate::mesh::builtin::builtin;
use crate::mesh::vertex_normals::NormalSource;
use crate::picture::LinearPicture;
use crate::raster::polygon_numbers;
use crate::scene::{Light, Scene};
use alloc::format;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DAffine3, DVec3};

pub(super) static FIGURE: Figure = Figure {
    name: "illumination",
    title: "Ambient, diffuse and specular light",
    lecture: "L21 2.1; L5, Phong reflection, Lambert's cosine law; CS171 2",
    make,
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [96, 96];
const LIGHT: DVec3 = DVec3::new(-0.5, 0.6, 0.7);
/// I_a k_a, I_p k_d, I_p k_s and the exponent: together at most 1, so that nothing is clamped.
const PARTS: [f32; 4] = [0.12, 0.5, 0.38, 30.0];

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    parts(&mut content)?;
    series(&mut content)?;
    cube(&mut content)?;
    Ok(content)
}

fn sphere(material: Material) -> Result<LinearPicture, FigureError> {
    drawn(
        &scene(
            builtin("sphere?rings=24&segments=48")?,
            material,
            LIGHT,
            1.1,
            SIZE,
        ),
        "naive-phong",
    )
}

/// The three terms of 2.1, and their sum.
fn parts(content: &mut Content) -> Result<(), FigureError> {
    let [a, d, s, n] = PARTS;
    let terms = [
        ("ambient", grey(a, 0.0, 0.0, n)),
        ("diffuse", grey(0.0, d, 0.0, n)),
        ("specular", grey(0.0, 0.0, s, n)),
    ];
    let pictures = terms.map(|(_, material)| sphere(material));
    let [ambient, diffuse, specular] = pictures;
    let all = [ambient?, diffuse?, specular?, sphere(grey(a, d, s, n))?];
    let mut sum = all[0].clone();
    for (texel, (d, s)) in sum
        .texels_mut()
        .iter_mut()
        .zip(all[1].texels().iter().zip(all[2].texels()))
    {
        (0..3).for_each(|c| texel[c] += d[c] + s[c]);
    }
    let captions = ["ambient", "diffuse", "specular", "all three"];
    content.text(
        "The three terms of equation 2.1, each alone, and all of them: the same sphere and light, drawn four times.",
    );
    let shown = captions
        .iter()
        .zip(&all)
        .map(|(caption, picture)| shown("A sphere", caption, picture))
        .collect();
    content.pictures(4, shown);
    let difference = levels(&sum, &all[3]);
    let holds = difference < 0.01;
    content.claim(
        "sum",
        "three pictures added up against one with all terms, largest difference",
        (difference, "grey levels"),
        holds,
        [
            "The terms add, to rounding.",
            "The terms do not add up to the whole.",
        ],
    );
    Ok(())
}

/// Diffuse light alone for growing k_d.
fn series(content: &mut Content) -> Result<(), FigureError> {
    let steps = [0.25f32, 0.5, 0.75, 1.0];
    let pictures = steps.map(|kd| sphere(grey(0.0, kd, 0.0, 1.0)));
    let mut shown_all = Vec::new();
    let mut brightest = Vec::new();
    for (kd, picture) in steps.iter().zip(pictures) {
        let picture = picture?;
        brightest.push(
            picture
                .texels()
                .iter()
                .map(|texel| texel[0])
                .fold(0.0, f32::max)
                / kd,
        );
        shown_all.push(shown(
            "A sphere in diffuse light",
            &format!("k_d = {kd}"),
            &picture,
        ));
    }
    content.pictures(4, shown_all);
    let spread = brightest
        .iter()
        .map(|b| f64::from((b / brightest[0] - 1.0).abs()))
        .fold(0.0, f64::max);
    let holds = spread < 1e-6;
    content.claim(
        "kd",
        "brightest pixel over k_d: largest relative change along the series",
        (spread, ""),
        holds,
        [
            "Diffuse light is proportional to k_d.",
            "Diffuse light is not proportional to k_d.",
        ],
    );
    Ok(())
}

/// The cube of the lecture, turned clockwise by `degrees` around the z axis, under light from above.
fn turned(degrees: f64) -> Result<Scene, FigureError> {
    let mut cube = scene(
        builtin("cube")?,
        grey(0.0, 1.0, 0.0, 1.0),
        DVec3::Y,
        2.4,
        SIZE,
    );
    // From the right and from above, so that the top is seen at every angle, and on grey, so that unlit faces are.
    cube.camera.eye = DVec3::new(2.8, 2.2, 3.4);
    cube.background = [0.3; 3];
    cube.lights = vec![Light::directional(DVec3::Y, [1.0; 3])];
    for object in &mut cube.objects {
        object.normals = NormalSource::Crease(30.0);
        object.transform = DAffine3::from_rotation_z(-degrees.to_radians());
    }
    Ok(cube)
}

/// What the face that was on top shows.
fn top(frame: &Frame, picture: &LinearPicture, degrees: f64) -> Option<f64> {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let up = DVec3::new(sin, cos, 0.0);
    let numbers = polygon_numbers(frame);
    let is_top = |number: u32| {
        let polygon = frame.polygons().get(number as usize);
        polygon.is_some_and(|p| {
            DVec3::from_array(frame.polygon_normal(p).map(f64::from)).dot(up) > 0.999
        })
    };
    let place = numbers.texels().iter().position(|&number| is_top(number))?;
    Some(f64::from(picture.texels()[place][0]))
}

/// L5: "top face of 60° rotated cube intercepts half the light".
fn cube(content: &mut Content) -> Result<(), FigureError> {
    let mut measured = Vec::new();
    let mut pictures = Vec::new();
    for degrees in [0.0, 15.0, 30.0, 45.0, 60.0, 75.0] {
        let scene = turned(degrees)?;
        let (frame, picture) = (scene.frame()?, drawn(&scene, "flat")?);
        if let Some(light) = top(&frame, &picture, degrees) {
            measured.push((degrees, light));
        }
        if degrees == 0.0 || degrees == 60.0 {
            pictures.push(shown(
                "A cube under light from above",
                &format!("turned by {degrees}°"),
                &picture,
            ));
        }
    }
    content.text("Lambert's law: the face that is on top receives light in proportion to the cosine of the angle by which the cube is turned.");
    content.pictures(2, pictures);
    content.plot(Plot {
        title: "Light on the face that was on top".into(),
        x: ("angle, degrees".into(), Scale::Linear),
        y: ("intensity".into(), Scale::Linear),
        series: vec![
            Series::new("measured on the picture", measured.iter().copied()),
            Series::new(
                "cosine",
                (0..=15).map(|i| {
                    (
                        5.0 * f64::from(i),
                        libm::cos((5.0 * f64::from(i)).to_radians()),
                    )
                }),
            ),
        ],
        marks: Vec::new(),
        caption: "Points are measured on the picture, the curve is the cosine.".into(),
    });
    let of = |degrees: f64| {
        measured
            .iter()
            .find(|m| m.0 == degrees)
            .map_or(f64::NAN, |m| m.1)
    };
    let ratio = of(60.0) / of(0.0);
    let holds = (ratio - 0.5).abs() < 1e-6;
    content.claim(
        "cube",
        "light on the top face at 60°, over that at 0°",
        (ratio, ""),
        holds,
        [
            "Half the light, as the lecture says.",
            "Not half the light.",
        ],
    );
    let worst = measured
        .iter()
        .map(|(d, light)| (light - libm::cos(d.to_radians())).abs())
        .fold(0.0, f64::max);
    let holds = worst < 1e-6;
    content.claim(
        "cosine",
        format!(
            "largest distance from the cosine at {} angles",
            measured.len()
        ),
        (worst, ""),
        holds,
        [
            format!("The cosine law, to rounding ({}).", written(worst)),
            "Not the cosine law.".into(),
        ],
    );
    Ok(())
}
