//! The exponent of the highlight: cosine powers, spheres for k_s and p, and N.H against R.V (L5; CS171 2, Figure 7).

use super::lit::{drawn, grey, scene, shown};
use super::stage::written;
use super::{Content, Figure, FigureError, Plot, Scale, Series};
use crate::mesh::builtin::builtin;
use crate::picture::LinearPicture;
use crate::scene::SpecularModel;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "exponents",
    title: "What the exponent does to the highlight",
    lecture: "L5, Cosine power plots; CS171 2, Figures 7 and 8",
    make,
};

const EXPONENTS: [f32; 5] = [1.0, 8.0, 32.0, 128.0, 512.0];
const STRENGTHS: [f32; 3] = [0.25, 0.5, 0.75];
/// Half of the height that is seen; the sphere has radius 1.
const HALF_HEIGHT: f64 = 1.1;

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    powers(&mut content);
    grid(&mut content)?;
    half_vector(&mut content)?;
    Ok(content)
}

/// The angle at which cos^p has come down to a half, in degrees.
fn half_width(p: f64) -> f64 {
    libm::acos(libm::pow(0.5, 1.0 / p)).to_degrees()
}

fn powers(content: &mut Content) {
    let curve = |p: f32| {
        let at = |i: i32| {
            (
                f64::from(i),
                libm::pow(libm::cos(f64::from(i).to_radians()).max(0.0), f64::from(p)),
            )
        };
        Series::new(format!("p = {p}"), (0..=90).map(at))
    };
    content.plot(Plot {
        title: "Cosine powers".into(),
        x: ("angle between R and V, degrees".into(), Scale::Linear),
        y: ("highlight".into(), Scale::Linear),
        series: EXPONENTS.map(curve).into(),
        marks: Vec::new(),
        caption: format!(
            "Half of the height is left at {}° for p = 1 and at {}° for p = 512.",
            written(half_width(1.0)),
            written(half_width(512.0))
        ),
    });
    let narrows = EXPONENTS
        .windows(2)
        .all(|p| half_width(f64::from(p[1])) < half_width(f64::from(p[0])));
    content.claim(
        "narrows",
        "half width at p = 1 over that at p = 512",
        (half_width(1.0) / half_width(512.0), ""),
        narrows,
        [
            "Increasing p narrows the lobe.",
            "Increasing p does not always narrow the lobe.",
        ],
    );
}

/// A sphere with light and eye in one direction.
fn sphere(
    strength: f32,
    exponent: f32,
    specular: SpecularModel,
    light: DVec3,
    side: u32,
) -> Result<LinearPicture, FigureError> {
    let material = grey(0.02, 0.2, strength, exponent);
    let mut scene = scene(
        builtin("sphere?rings=32&segments=64")?,
        material,
        light,
        HALF_HEIGHT,
        [side; 2],
    );
    (scene.specular, scene.shininess_for) = (specular, specular);
    drawn(&scene, "naive-phong")
}

/// The grid of the lecture, k_s downward and p to the right.
fn grid(content: &mut Content) -> Result<(), FigureError> {
    let mut pictures = Vec::new();
    let mut bright = Vec::new();
    for strength in STRENGTHS {
        for exponent in EXPONENTS {
            let picture = sphere(
                strength,
                exponent,
                SpecularModel::Phong,
                DVec3::new(-0.4, 0.5, 0.8),
                56,
            )?;
            if strength == STRENGTHS[2] {
                // Over what diffuse and ambient light give at most.
                let lit = super::lit::share(&picture, |texel| texel[0] > 0.22 + strength / 2.0);
                bright.push(lit);
            }
            pictures.push(shown(
                "A sphere with a highlight",
                &format!("k_s {strength}, p {exponent}"),
                &picture,
            ));
        }
    }
    content.text("The strength k_s grows downward, the exponent p to the right.");
    content.pictures(EXPONENTS.len(), pictures);
    let (matte, shiny) = (bright[0], bright[3]);
    let is_shiny_at_one = matte < shiny;
    content.claim("shiny", format!("share of the sphere in the highlight, p = {} over p = {}", EXPONENTS[0], EXPONENTS[3]), (matte / shiny.max(1e-4), ""), is_shiny_at_one, ["A p close to 1 makes the smaller highlight, as the notes' text says.", "The text of CS171 says that a very shiny surface has a p close to 1; its own Figure 7, and these spheres, say that it has a large one."]);
    Ok(())
}

/// The half width of the highlight alone, in degrees of the surface, on the middle row of a sphere lit from the eye.
fn measured(exponent: f32, specular: SpecularModel) -> Result<(f64, Vec<(f64, f64)>), FigureError> {
    const SIDE: u32 = 481;
    let material = grey(0.0, 0.0, 1.0, exponent);
    let mut scene = scene(
        builtin("sphere?rings=96&segments=192")?,
        material,
        DVec3::Z,
        HALF_HEIGHT,
        [SIDE, 3],
    );
    // Three rows of the picture of full height: the middle one passes through the middle of the sphere.
    scene.camera.projection = crate::scene::Projection::Orthographic {
        half_height: 3.0 * HALF_HEIGHT / f64::from(SIDE),
    };
    (scene.specular, scene.shininess_for) = (specular, specular);
    let picture = drawn(&scene, "naive-phong")?;
    let degrees = |x: f64| {
        let across = 2.0 * HALF_HEIGHT * (x + 0.5 - f64::from(SIDE) / 2.0) / f64::from(SIDE);
        libm::asin(across.clamp(-1.0, 1.0)).to_degrees()
    };
    let row = picture.row(1);
    let middle = SIDE as usize / 2;
    let points: Vec<(f64, f64)> = (middle..SIDE as usize)
        .filter(|&x| row[x][3] > 0.0)
        .map(|x| (degrees(x as f64), f64::from(row[x][0])))
        .collect();
    // Between the last pixel over a half and the next one, on the line through both.
    let last = points.iter().rposition(|p| p.1 >= 0.5).unwrap_or(0);
    let (a, b) = (points[last], points[(last + 1).min(points.len() - 1)]);
    let part = if a.1 > b.1 {
        (a.1 - 0.5) / (a.1 - b.1)
    } else {
        0.0
    };
    Ok((a.0 + part * (b.0 - a.0), points))
}

/// N·H with the exponent of R·V, and with four times as much.
fn half_vector(content: &mut Content) -> Result<(), FigureError> {
    let kinds = [
        ("R·V, p = 20", 20.0, SpecularModel::Phong),
        ("N·H, p = 20", 20.0, SpecularModel::Blinn),
        ("N·H, p = 80", 80.0, SpecularModel::Blinn),
    ];
    let (mut widths, mut series, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    for (label, exponent, specular) in kinds {
        let (width, points) = measured(exponent, specular)?;
        widths.push(width);
        series.push(Series::new(
            label,
            points.into_iter().filter(|p| p.0 < 60.0).step_by(3),
        ));
        pictures.push(shown(
            "A sphere with a highlight",
            label,
            &sphere(0.75, exponent, specular, DVec3::Z, 80)?,
        ));
    }
    content.text(
        "The vector halfway between light and eye turns half as fast as R: the same exponent makes a wider highlight.",
    );
    content.pictures(3, pictures);
    content.plot(Plot {
        title: "The highlight along the equator of the sphere, lit from the eye".into(),
        x: ("angle of the normal, degrees".into(), Scale::Linear),
        y: ("highlight".into(), Scale::Linear),
        series,
        marks: Vec::new(),
        caption: "The curves of R·V, of N·H with its exponent, and of N·H with four times it."
            .into(),
    });
    let [phong, same, converted] = [widths[0], widths[1], widths[2]];
    // Half of the angle, so that the width doubles where cos^p is a Gauss curve.
    let wider = same / phong > 1.5;
    content.claim(
        "same-exponent",
        "half width of N·H over that of R·V, same exponent",
        (same / phong, ""),
        !wider,
        [
            "The same exponent gives the same highlight.",
            "CS171 says that the angle at H \"can also be used\": not with the same exponent.",
        ],
    );
    let alike = (converted / phong - 1.0).abs() < 0.05;
    content.adds(
        "converted",
        "half width of N·H with four times the exponent, over that of R·V",
        (converted / phong, ""),
        if alike {
            "Four times the exponent makes up for it."
        } else {
            "Four times the exponent does not make up for it."
        },
    );
    content.adds("half-width", "half width of R·V for p = 20 on the sphere", (phong, "degrees"), // The normal turns half as fast as R.
        String::from(if (phong - half_width(20.0) / 2.0).abs() < 0.1 {
            "Half of the angle at which the cosine power has come down to a half: the normal turns half as fast as R."
        } else {
            "Not what the cosine power says."
        }));
    Ok(())
}
