//! From a scene file to the settings that decide which polygon is seen: hidden surfaces, clipping,
//! samples.

use super::check::Section;
use super::diagnostics::SceneError;
use crate::note::{Note, Notes};
use crate::scene::{Clipping, DepthBits, DepthBuffer, HiddenSurfaces, Interpolation, Scene};
use std::format;

/// Returns the method for hidden surfaces. Warns about a key that has no effect under this method.
pub(super) fn hidden_surfaces(
    scene: &Section,
    notes: &mut Notes,
) -> Result<HiddenSurfaces, SceneError> {
    let is_known = |bits| [16, 24, 32].contains(&bits);
    let bits = match scene.whole("depth_bits", is_known, "16, 24 or 32")? {
        Some(16) => DepthBits::Sixteen,
        Some(24) => DepthBits::TwentyFour,
        _ => DepthBits::ThirtyTwo,
    };
    let choice = scene.table.text("visibility").unwrap_or("z-buffer");
    for (key, needs) in [
        ("depth_bits", "z-buffer"),
        ("depth", "z-buffer"),
        ("painter_key", "painter"),
    ] {
        if scene.has(key) && choice != needs {
            let name = scene.name(key);
            let text = format!("`{name}` has no effect without visibility = \"{needs}\"");
            notes.push(Note::warning("no-effect", text));
        }
    }
    Ok(match choice {
        "painter" => HiddenSurfaces::Painter(scene.word("painter_key")),
        "draw-order" => HiddenSurfaces::DrawOrder,
        _ => HiddenSurfaces::ZBuffer(DepthBuffer {
            bits,
            source: scene.word("depth"),
        }),
    })
}

/// Returns the clipping method. CS171's works only with interpolation on the screen.
pub(super) fn clipping(scene: &Section) -> Result<Clipping, SceneError> {
    let clipping = scene.word("clipping");
    let is_perspective = scene.word::<Interpolation>("interpolation") == Interpolation::Perspective;
    if clipping == Clipping::NdcCube && is_perspective {
        let why = "expected interpolation = \"screen\" with \"ndc-cube\": corners behind the eye have no weight";
        return Err(scene.conflict("clipping", "interpolation", why));
    }
    Ok(clipping)
}

/// Returns the samples per pixel along each side. The argument is the size of the picture.
pub(super) fn samples(image: &Section, [width, height]: [u32; 2]) -> Result<u32, SceneError> {
    let is_known = |samples| [1, 2, 4, 8].contains(&samples);
    let samples = image.whole("samples", is_known, "1, 2, 4 or 8")?;
    let (longest, most) = (width.max(height), Scene::MAX_SIDE);
    let expected = format!("at most {most} samples per side, and there are {longest} pixels");
    image.whole("samples", |samples| longest * samples <= most, &expected)?;
    Ok(samples.unwrap_or(1))
}
