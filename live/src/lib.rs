//! The interface between the page and its live view. The page reaches a scene, its frame, pictures
//! of the frame and figures through functions that accept and return only numbers.
//!
//! Texts (scenes, names of methods, messages) pass through one buffer, which is called *the text*
//! below. The page writes it at the address that [`text`] returns, and reads it at [`said`]. One
//! instance of the module is one studio. A page that shows several scenes makes several instances,
//! so no function needs a handle. The module needs no unsafe block, because the page reads its
//! memory at the addresses that functions return. A function that fails returns a negative value:
//! minus the length of a message, which it leaves in the text.

mod figures;
mod notes;
mod parameters;
mod scene_file;
mod studio;
#[cfg(test)]
mod tests;

use std::cell::RefCell;
use studio::Studio;

thread_local! { static STUDIO: RefCell<Studio> = RefCell::default(); }

fn with<R>(what: impl FnOnce(&mut Studio) -> R) -> R {
    STUDIO.with_borrow_mut(what)
}

/// Makes room for a text of `length` bytes, and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn text(length: usize) -> *mut u8 {
    with(|studio| {
        studio.text = vec![0; length];
        studio.text.as_mut_ptr()
    })
}

/// Returns the address of the text.
#[unsafe(no_mangle)]
pub extern "C" fn said() -> *const u8 {
    with(|studio| studio.text.as_ptr())
}

/// Stores the text as a file: its first line is the name, and the rest is the content.
#[unsafe(no_mangle)]
pub extern "C" fn file() {
    with(Studio::file);
}

/// Loads the text as a scene in TOML, or as the name of a mesh file that was stored by [`file`],
/// for pictures of this size. If the width or the height is 0, the scene's size stays. A mesh looks
/// as `fastphong render` shows it. Returns how many polygons the scene has.
#[unsafe(no_mangle)]
pub extern "C" fn load(width: u32, height: u32) -> isize {
    with(|studio| studio.answer(|studio| studio.load([width, height])))
}

/// Returns the address of the direction to the scene's first light, three `f64`: to the right,
/// upward, toward the eye. All are 0 if there is no light.
#[unsafe(no_mangle)]
pub extern "C" fn light() -> *const f64 {
    with(Studio::light)
}

/// Makes the frame of a view. Returns how many polygons are in view.
///
/// - `width`, `height`: the size of the picture in pixels.
/// - `azimuth`, `elevation`: the angles in radians that the camera is turned by.
/// - `zoom`: the zoom.
/// - `lx`, `ly`, `lz`: the direction to the first light. (0, 0, 0) leaves it where the eye sees it
///   in the scene.
/// - `shininess`: the exponent of all materials. 0 keeps their own.
/// - `samples`: the samples per pixel along each side. 0 keeps the scene's.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // the boundary passes only numbers
pub extern "C" fn frame(
    width: u32,
    height: u32,
    azimuth: f64,
    elevation: f64,
    zoom: f64,
    lx: f64,
    ly: f64,
    lz: f64,
    shininess: f32,
    samples: u32,
) -> isize {
    let view = studio::View {
        size: [width, height],
        azimuth,
        elevation,
        zoom,
        light: [lx, ly, lz],
        shininess,
        samples,
    };
    with(|studio| studio.answer(|studio| studio.look(&view)))
}

/// Returns the address of the azimuth and the elevation of the frame, two `f64`. They may differ
/// from those that the page asked for, because no camera turns beyond the poles.
#[unsafe(no_mangle)]
pub extern "C" fn turned() -> *const f64 {
    with(|studio| studio.turned.as_ptr())
}

/// Writes what to know about the scene, its meshes and the frame into the text, one note per line,
/// warnings first. Returns its length. Takes about as long as drawing the frame by the reference.
#[unsafe(no_mangle)]
pub extern "C" fn notes() -> usize {
    with(Studio::notes)
}

/// Writes the scene in its current view into the text, as TOML, and returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn scene() -> isize {
    with(|studio| studio.answer(Studio::scene))
}

/// Draws the frame by what the text names: a method, `auto`, `reference`, or the reference of
/// another model, as in `reference:model=gouraud`. Stores the result as the exact picture if
/// `is_exact` is not 0, else as the picture. Returns 0.
#[unsafe(no_mangle)]
pub extern "C" fn draw(is_exact: u32) -> isize {
    with(|studio| studio.answer(|studio| studio.draw(is_exact != 0)))
}

/// Stores the picture over its background as RGBA bytes in the scene's encoding, and returns their
/// address.
#[unsafe(no_mangle)]
pub extern "C" fn picture() -> *const u8 {
    with(Studio::stored)
}

/// Compares the picture with the exact one. Pixels where the reference shows a different polygon
/// count as equal. Returns the address of five `f64`: the largest error in grey levels, its column
/// and row, the root mean square error, and the count of pixels.
#[unsafe(no_mangle)]
pub extern "C" fn compare() -> *const f64 {
    with(Studio::compare)
}

/// Returns the address of the errors of all pixels from the last comparison: `f32` in grey levels.
#[unsafe(no_mangle)]
pub extern "C" fn errors() -> *const f32 {
    with(|studio| studio.errors.as_ptr())
}

/// Lists the parameters of the method that the text names. Writes them into the text as JSON, and
/// returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn parameters() -> isize {
    with(|studio| studio.answer(Studio::parameters))
}

/// Makes the figure that the first line of the text names, with the values of its handles in the
/// second line. Writes its content into the text as JSON, and returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn figure() -> isize {
    with(|studio| studio.answer(Studio::figure))
}

/// Traces how the method in the first line of the text draws the mesh of the figure `stop`. The
/// second line has x and y of its corners, in pixels. Writes the trace into the text as JSON, and
/// returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn trace() -> isize {
    with(|studio| studio.answer(Studio::trace))
}

/// Returns the address of three `u32` about the figure's picture at `index`: its width, its height,
/// and the address of its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn panel(index: usize) -> *const u32 {
    with(|studio| studio.panel(index))
}
