//! The boundary of the page's live view: a scene, its frame, a picture of it, and figures, behind functions of numbers.
//!
//! Texts (scenes, names of methods, messages) pass through one buffer, [`text`]. One instance of the module is one studio: a page
//! that shows several scenes makes several instances, so nothing here needs a handle. There is no unsafe block: the page reads
//! the module's memory at the addresses that functions return. A function that may fail returns a number below 0 then: minus the
//! length of a message, which the text is.

mod figures;
mod parameters;
mod scene_file;
mod studio;

use std::cell::RefCell;
use studio::Studio;

thread_local! { static STUDIO: RefCell<Studio> = RefCell::default(); }

fn with<R>(what: impl FnOnce(&mut Studio) -> R) -> R {
    STUDIO.with_borrow_mut(what)
}

/// Makes room for a text of `length` bytes, and returns where.
#[unsafe(no_mangle)]
pub extern "C" fn text(length: usize) -> *mut u8 {
    with(|studio| {
        studio.text = vec![0; length];
        studio.text.as_mut_ptr()
    })
}

/// Returns where the text is.
#[unsafe(no_mangle)]
pub extern "C" fn said() -> *const u8 {
    with(|studio| studio.text.as_ptr())
}

/// Takes the text as a file: its first line is the name, all else what is in it.
#[unsafe(no_mangle)]
pub extern "C" fn file() {
    with(Studio::file);
}

/// Takes the text as a scene, as TOML, or as the name of a mesh file that was taken before. Returns the number of its polygons.
#[unsafe(no_mangle)]
pub extern "C" fn load() -> isize {
    with(|studio| studio.answer(Studio::load))
}

/// Returns where the direction to the scene's first light is, three `f64`: to the right, upward, toward the eye. All are 0 if
/// there is no light.
#[unsafe(no_mangle)]
pub extern "C" fn light() -> *const f64 {
    with(Studio::light)
}

/// Makes the frame: its size, the camera turned by an azimuth and an elevation in radians, the zoom, the direction to the first light
/// (0, 0, 0: where the eye has it in the scene), the exponent of all materials (0: their own), and the samples per pixel along each
/// side (0: the scene's). Returns the polygons in view.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // the boundary takes numbers, and each call makes a whole frame
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

/// Returns where the angles are that the frame was turned by, two `f64`, azimuth and elevation: no camera turns beyond the poles.
#[unsafe(no_mangle)]
pub extern "C" fn turned() -> *const f64 {
    with(|studio| studio.turned.as_ptr())
}

/// Makes what was odd about the scene the text, a line each, and returns its length.
#[unsafe(no_mangle)]
pub extern "C" fn warnings() -> usize {
    with(|studio| studio.say(studio.warnings.join("\n")))
}

/// Writes the scene as it is looked at, as TOML: the text then, whose length is returned.
#[unsafe(no_mangle)]
pub extern "C" fn scene() -> isize {
    with(|studio| studio.answer(Studio::scene))
}

/// Draws the frame by the method that the text names, or `reference`, as the picture, or as the exact one if `is_exact`. Returns 0.
#[unsafe(no_mangle)]
pub extern "C" fn draw(is_exact: u32) -> isize {
    with(|studio| studio.answer(|studio| studio.draw(is_exact != 0)))
}

/// Stores the picture in bytes, RGBA, as the scene encodes it, and returns where.
#[unsafe(no_mangle)]
pub extern "C" fn picture() -> *const u8 {
    with(Studio::stored)
}

/// Compares the picture with the exact one, but for pixels where the reference shows another polygon. Returns where `f64` numbers are: the largest error in grey levels, its column and row,
/// the root of the mean square, the pixels compared.
#[unsafe(no_mangle)]
pub extern "C" fn compare() -> *const f64 {
    with(Studio::compare)
}

/// Returns where the errors of all pixels are that were compared last, `f32`, in grey levels.
#[unsafe(no_mangle)]
pub extern "C" fn errors() -> *const f32 {
    with(|studio| studio.errors.as_ptr())
}

/// Lists the parameters of the method that the text names, as JSON: the text then, whose length is returned.
#[unsafe(no_mangle)]
pub extern "C" fn parameters() -> isize {
    with(|studio| studio.answer(Studio::parameters))
}

/// Makes the figure that the first line of the text names, with a value of each handle in the second. The text is then its content
/// as JSON, and the length of that is returned.
#[unsafe(no_mangle)]
pub extern "C" fn figure() -> isize {
    with(|studio| studio.answer(Studio::figure))
}

/// Traces the method that the first line of the text names on the mesh of the figure `stop`, with columns and lines of its corners in
/// the second. The text is then the trace as JSON, and the length of that is returned.
#[unsafe(no_mangle)]
pub extern "C" fn trace() -> isize {
    with(|studio| studio.answer(Studio::trace))
}

/// Returns where three numbers (`u32`) of the figure's picture `number` are: its width, its height, and where its bytes are.
#[unsafe(no_mangle)]
pub extern "C" fn panel(number: usize) -> *const u32 {
    with(|studio| studio.panel(number))
}
