//! What a depth buffer holds: how it is computed, and how far its bits reach (L5).

use super::stage::{differing, shipped, stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Plot, Scale, Series, Shown};
use crate::picture::LinearPicture;
use crate::raster::depth;
use crate::scene::{DepthBits, DepthBuffer, DepthSource, HiddenSurfaces, Scene};
use crate::shading::Variant;
use alloc::format;
use alloc::vec::Vec;

pub(super) static FIGURE: Figure = Figure {
    name: "depth",
    title: "Depth: two ways to compute it, and 16, 24 or 32 bits to keep it",
    lecture: "L5, Z-buffer, Z-value Computation",
    make,
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [160, 120];

/// The widths of L5, "16 to 32 bits".
const BITS: [(&str, DepthBits); 3] = [
    ("16", DepthBits::Sixteen),
    ("24", DepthBits::TwentyFour),
    ("32", DepthBits::ThirtyTwo),
];

fn with(scene: &Scene, bits: DepthBits, source: DepthSource) -> Scene {
    Scene {
        hidden_surfaces: HiddenSurfaces::ZBuffer(DepthBuffer { bits, source }),
        ..scene.clone()
    }
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let scene = shipped("z-fighting", SIZE)?;
    fighting(&mut content, &scene)?;
    ways(&mut content, &scene)?;
    curve(&mut content, &scene);
    Ok(content)
}

/// A star a little above a floor: with too few bits both have one depth.
fn fighting(content: &mut Content, scene: &Scene) -> Result<(), FigureError> {
    let mut pictures: Vec<(&str, LinearPicture)> = Vec::new();
    for (name, bits) in BITS {
        let frame = with(scene, bits, DepthSource::Interpolated).frame()?;
        pictures.push((name, Variant::parse("flat")?.render_linear(&frame)));
    }
    content.text(
        "A star that floats a little above a floor, drawn after it, far from the eye. Where a buffer of few bits rounds both \
         depths to one number the floor stays: z-fighting.",
    );
    let shown = |(bits, picture): &(&str, LinearPicture)| {
        Shown::new(
            format!("{bits} bits"),
            format!("A star above a floor with {bits} bits of depth."),
            stored(picture),
        )
    };
    content.pictures(3, pictures.iter().map(shown).collect());
    let finest = &pictures[2].1;
    for (bits, picture) in &pictures[..2] {
        let wrong = differing(picture, finest);
        content.adds(
            format!("fighting-{bits}"),
            format!("pixels that {bits} bits show differently than 32"),
            (wrong as f64, "pixels"),
            if wrong > 0 {
                format!("{bits} bits are too few here.")
            } else {
                format!("{bits} bits are enough here.")
            },
        );
    }
    Ok(())
}

/// The largest difference of depths where both are finite.
fn apart(a: &crate::picture::Picture<f32>, b: &crate::picture::Picture<f32>) -> f64 {
    let both = a
        .texels()
        .iter()
        .zip(b.texels())
        .filter(|(a, b)| a.is_finite() && b.is_finite());
    both.map(|(a, b)| f64::from((a - b).abs()))
        .fold(0.0, f64::max)
}

/// Depth interpolated between corners, and computed at each sample.
fn ways(content: &mut Content, scene: &Scene) -> Result<(), FigureError> {
    let of =
        |source| Ok::<_, FigureError>(depth(&with(scene, DepthBits::ThirtyTwo, source).frame()?));
    let difference = apart(
        &of(DepthSource::Interpolated)?,
        &of(DepthSource::PerSample)?,
    );
    let steps = f64::from(SIZE[0] + SIZE[1]);
    // Corners, and each step along an edge and a span, round depths of up to 1 by 2⁻²⁵, on both ways; the second scales 1/w
    // by f/(f − n), which is close to 1.
    let bound = 4.0 * (steps + 4.0) / f64::from(1 << 25);
    let same = difference <= bound;
    content.claim("ways", "largest difference of depth by both ways", (difference, ""), same, ["Interpolated between corners or computed at each sample: the same to rounding, as 1/z is linear on the screen.", "The two ways differ by more than rounding."]);
    Ok(())
}

/// Depth over distance: `z ↦ (f + n)/(f − n) + (1/z) 2fn/(f − n)`, from −1 to 1 (L5, z negative).
fn lecture_depth(distance: f64, near: f64, far: f64) -> f64 {
    let z = -distance;
    (far + near) / (far - near) + 2.0 * far * near / (far - near) / z
}

fn curve(content: &mut Content, scene: &Scene) {
    let far = scene.camera.far;
    let nears = [
        scene.camera.near,
        5.0 * scene.camera.near,
        25.0 * scene.camera.near,
    ];
    let curve = |near: f64| {
        let distance = move |i: u32| near * libm::pow(far / near, f64::from(i) / 60.0);
        let points = (0..=60).map(move |i| {
            (
                distance(i),
                0.5 + 0.5 * lecture_depth(distance(i), near, far),
            )
        });
        Series::new(format!("near = {}", written(near)), points)
    };
    content.plot(Plot {
        title: "Depth over distance".into(),
        x: ("distance from the eye".into(), Scale::Log),
        y: ("depth, 0 near to 1 far".into(), Scale::Linear),
        series: nears.into_iter().map(curve).collect(),
        marks: Vec::new(),
        caption: format!(
            "L5's formula, mapped to 0..1, for a far plane at {}. \"Z-value is preserved after projection\" is not so: its \
             order is, and the nearer the near plane, the fewer levels are left for what is far.",
            written(far)
        ),
    });
    let near = scene.camera.near;
    let half = 0.5 + 0.5 * lecture_depth(2.0 * near, near, far);
    content.adds(
        "half",
        "part of the depth range used up at twice the near distance",
        (half, ""),
        format!(
            "Of distances up to {}, those below {} take {:.0} % of the levels.",
            written(far),
            written(2.0 * near),
            100.0 * half
        ),
    );
    let monotone = (1..1000).all(|i| {
        let at = |i: u32| near + (far - near) * f64::from(i) / 1000.0;
        lecture_depth(at(i), near, far) < lecture_depth(at(i + 1), near, far)
    });
    let moved =
        (lecture_depth(0.5 * far, near, far) - (0.5 * far - near) / (far - near) * 2.0 + 1.0).abs();
    content.found(Finding::new(
        "preserved",
        "how far half-way to the far plane is from half-way in depth, of 2",
        (moved, ""),
        Agreement::if_holds(moved < 1e-3),
        if moved < 1e-3 {
            "Depth is preserved."
        } else if monotone {
            "Depth keeps the order of distances and nothing else (\"preserved\", L5)."
        } else {
            "Depth does not even keep the order."
        },
    ));
}
