//! Highlights from behind, and where colours are clamped (CS171 2; L5; L21 3).

use super::lit::{drawn, grey, levels, scene, shown};
use super::{Content, Figure, FigureError};
use crate::compare::metrics::compare;
use crate::mesh::builtin::builtin;
use crate::picture::LinearPicture;
use crate::reference::{self, Model};
use crate::scene::{Scene, SpecularGate, SpecularModel};
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "gates",
    title: "Light from behind, and where colours are clamped",
    lecture: "CS171 2, Specular reflection; L5; L21 2.1, L21 3",
    make,
};

/// From behind and above: it lights what turns away from the eye.
const BEHIND: DVec3 = DVec3::new(-0.55, 0.5, -0.67);
/// A grazing light makes long highlights with a small exponent.
const EXPONENT: f32 = 12.0;

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    gates(&mut content)?;
    clamping(&mut content)?;
    Ok(content)
}

/// A torus in light from behind, its highlights by N·H as the lectures print them.
fn torus(gate: SpecularGate, diffuse: f32) -> Result<Scene, FigureError> {
    let mesh = builtin("torus?segments=96&sides=48")?;
    let mut scene = scene(
        mesh,
        grey(0.08, diffuse, 0.8, EXPONENT),
        BEHIND,
        1.5,
        [112, 112],
    );
    (scene.specular, scene.shininess_for, scene.gate) =
        (SpecularModel::Blinn, SpecularModel::Blinn, gate);
    Ok(scene)
}

/// The largest step between neighbours in a row, both covered and of the same surface, in levels. Edges of the outline
/// are steps of depth; here both pictures have them, so that they are left out by `other`.
fn largest_step(picture: &LinearPicture, other: &LinearPicture) -> f64 {
    let mut largest: f64 = 0.0;
    for y in 0..picture.height() {
        let (row, smooth) = (picture.row(y), other.row(y));
        for x in 1..row.len() {
            let covered = row[x][3] > 0.0 && row[x - 1][3] > 0.0;
            // The part of the step that the other picture does not have.
            let step = (row[x][0] - row[x - 1][0]).abs() - (smooth[x][0] - smooth[x - 1][0]).abs();
            largest = if covered {
                largest.max(f64::from(255.0 * step))
            } else {
                largest
            };
        }
    }
    largest
}

fn gates(content: &mut Content) -> Result<(), FigureError> {
    let kinds = [
        ("none where L·N ≤ 0 (default)", SpecularGate::Gated),
        ("as printed in CS171 and L5", SpecularGate::Ungated),
        ("weighted by L·N", SpecularGate::Weighted),
    ];
    let pictures = kinds.map(|(_, gate)| drawn(&torus(gate, 0.4)?, "duff-phong"));
    let [gated, ungated, weighted] = pictures;
    let all: [LinearPicture; 3] = [gated?, ungated?, weighted?];
    // Diffuse light alone: where it is not over ambient light, the surface is turned away from the light.
    let mut matte = torus(SpecularGate::Gated, 0.4)?;
    matte
        .objects
        .iter_mut()
        .for_each(|object| object.material = Some(grey(0.08, 0.4, 0.0, 1.0)));
    let matte = drawn(&matte, "duff-phong")?;
    content.text(
        "A torus in light from behind it. The lectures raise a cosine to a power without asking whether the light reaches \
         the surface at all.",
    );
    let shown_all = kinds
        .iter()
        .zip(&all)
        .map(|(kind, picture)| shown("A torus lit from behind, highlights", kind.0, picture));
    content.pictures(3, shown_all.collect());
    let behind = |picture: &LinearPicture| {
        let pairs = picture
            .texels()
            .iter()
            .zip(matte.texels())
            .filter(|(_, m)| m[3] > 0.0);
        let away = pairs.filter(|(_, m)| f64::from(m[0]) <= 0.08 + 1e-6);
        let (mut count, mut shining) = (0usize, 0usize);
        for (texel, m) in away {
            count += 1;
            shining += usize::from(texel[0] - m[0] > 2.0 / 255.0);
        }
        100.0 * shining as f64 / count.max(1) as f64
    };
    let (from_behind, none) = (behind(&all[1]), behind(&all[0]).max(behind(&all[2])));
    let shines = from_behind > 1.0;
    content.claim(
        "behind",
        "share of the surface turned away from the light that shines, as printed",
        (from_behind, "%"),
        !shines,
        [
            "No light from behind is seen.",
            "Light from behind shines through.",
        ],
    );
    content.adds(
        "behind-gated",
        "the same with a gate or a weight",
        (none, "%"),
        if none == 0.0 {
            "None."
        } else {
            "Some is left."
        },
    );
    let (line, no_line) = (
        largest_step(&all[0], &all[2]),
        largest_step(&all[2], &all[0]),
    );
    let is_line = line > 2.0 * no_line;
    content.adds(
        "line",
        "largest step between neighbouring pixels that the gate makes and the weight does not",
        (line, "grey levels"),
        if is_line {
            "The gate ends highlights in a hard line; the weight does not."
        } else {
            "The gate makes no line that the weight does not."
        },
    );
    Ok(())
}

/// A coarse sphere with more light than a picture can hold.
fn clamping(content: &mut Content) -> Result<(), FigureError> {
    let mesh = builtin("sphere?rings=8&segments=16")?;
    let bright = scene(
        mesh,
        grey(0.2, 1.0, 0.6, 10.0),
        DVec3::new(-0.4, 0.5, 0.8),
        1.1,
        [112, 112],
    );
    let frame = bright.frame()?;
    let truth = reference::render(&frame, Model::Phong).to_linear();
    let (clamped, separate) = (
        drawn(&bright, "gouraud")?,
        drawn(&bright, "gouraud-separate")?,
    );
    content.text(
        "An overexposed sphere: Gouraud's method with colours clamped at the vertices, with colours clamped at the pixels, \
         and shading at every pixel.",
    );
    let pictures: Vec<_> = [
        ("clamped at the vertices", &clamped),
        ("clamped at the pixels", &separate),
        ("lit at each pixel", &truth),
    ]
    .map(|(caption, picture)| shown("An overexposed sphere", caption, picture))
    .into();
    content.pictures(3, pictures);
    let difference = levels(&clamped, &separate);
    content.adds(
        "clamped",
        "clamped at vertices against clamped at pixels, largest difference",
        (difference, "grey levels"),
        if difference > 1.0 {
            "Clamping and interpolating cannot be exchanged."
        } else {
            "It makes no difference here."
        },
    );
    let rms =
        |picture: &LinearPicture| compare(&truth, picture).map(|difference| 255.0 * difference.rms);
    let (first, last) = (rms(&clamped)?, rms(&separate)?);
    content.adds(
        "nearer",
        "RMS error of clamping at vertices over that of clamping at pixels",
        (first / last, ""),
        if first > last {
            "Colours that are clamped last are nearer to shading at every pixel."
        } else {
            "Colours that are clamped first are nearer to shading at every pixel."
        },
    );
    Ok(())
}
