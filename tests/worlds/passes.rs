//! Drawing a frame by a shader from outside the crate, after one that panics, in a part of a
//! picture, and over depths that were drawn before.

use super::renderers::{name, renderers};
use fastphong::frame::Frame;
use fastphong::number::{Num, Vec3, vec3};
use fastphong::picture::{Picture8, PictureMut};
use fastphong::raster::{Background, DepthTest, DrawError, DrawOptions, Renderer};
use fastphong::shading::{Info, LightAt, Linear, MethodRow, Normal, Shader, Span, Variant};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// One colour, which no light makes; or a panic, which prints nothing.
#[derive(Clone, Copy, Default)]
struct Fixed<const FAILS: bool>;

static FIXED: MethodRow = MethodRow::of::<Fixed<false>>();
static FAILING: MethodRow = MethodRow::of::<Fixed<true>>();

impl<const FAILS: bool> Shader for Fixed<FAILS> {
    const INFO: Info = Info {
        name: "fixed",
        ..Info::OF_PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = Linear<Vec3<F>>;

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        if FAILS {
            resume_unwind(Box::new(()));
        }
        vec3([0.25, 1.5, -1.0].map(|c| n.x.broadcast(c)))
    }
}

/// Checks all of these, and returns how many second passes drew what the first one drew.
pub fn check(frame: &Frame) -> Result<usize, String> {
    let fixed = FIXED.variant();
    let expected = fixed.render(frame).map_err(|error| error.to_string())?;
    for renderer in renderers() {
        let failing = || FAILING.variant().render_with(frame, renderer);
        let failed = catch_unwind(AssertUnwindSafe(failing)).is_err();
        // Rows are shaded by blocks, and a block may hold the edge of a polygon and no pixel of it.
        if !failed && expected.pixels().iter().any(|pixel| pixel[3] > 0) {
            return Err(format!("a shader's panic is lost by {}", name(renderer)));
        }
        if in_part(&fixed, frame, renderer)? != expected {
            return Err(format!("the colour is another by {}", name(renderer)));
        }
    }
    let ends = [Renderer::Span, Renderer::fastest()];
    let methods = ["phong-rsqrt", "slerp-phong", "phong-map"];
    let mut passes = 0;
    for (first, second) in pairs(&methods) {
        for (by_first, by_second) in pairs(&ends) {
            passes += second_pass(frame, (first, by_first), (second, by_second))?;
        }
    }
    Ok(passes)
}

fn pairs<T: Copy>(all: &[T]) -> impl Iterator<Item = (T, T)> {
    all.iter()
        .flat_map(move |a| all.iter().map(move |b| (*a, *b)))
}

/// Draws a frame in the middle of a larger picture, and returns that part. Nothing else may change.
fn in_part(variant: &Variant, frame: &Frame, renderer: Renderer) -> Result<Picture8, String> {
    let size = [frame.picture_width(), frame.picture_height()];
    let mut picture = Picture8::new(size[0] + 5, size[1] + 2, [9; 4]);
    let part = PictureMut::from(&mut picture).part([3, 1], size);
    let drawn = variant.draw(frame, part, DrawOptions::by(renderer));
    drawn.map_err(|error| error.to_string())?;
    let mut inner = Picture8::new(size[0], size[1], [0; 4]);
    for y in 0..picture.height() {
        for x in 0..picture.width() {
            let is_inner = (3..3 + size[0]).contains(&x) && (1..1 + size[1]).contains(&y);
            if is_inner {
                inner.row_mut(y - 1)[x - 3] = picture.get(x, y);
            } else if picture.get(x, y) != [9; 4] {
                return Err(format!("{} writes beside its part", name(renderer)));
            }
        }
    }
    Ok(inner)
}

/// Draws a frame twice with one depth buffer. Returns 1 if the second pass drew all that the first
/// one did, as one engine must, and 0 otherwise: engines differ, and where a frame has few samples
/// this may not be seen.
fn second_pass(
    frame: &Frame,
    first: (&str, Renderer),
    second: (&str, Renderer),
) -> Result<usize, String> {
    let mut depth = vec![f32::INFINITY; frame.width() * frame.height()];
    let mut draw = |(method, renderer): (&str, Renderer), test| {
        let mut picture = Picture8::new(frame.picture_width(), frame.picture_height(), [0; 4]);
        let options = DrawOptions::by(renderer)
            .background(Background::Kept)
            .depth(&mut depth)
            .depth_test(test);
        let variant = Variant::parse(method).expect("a method");
        let engine = variant.draw(frame, &mut picture, options)?.engine();
        let alphas: Vec<u8> = picture.pixels().iter().map(|pixel| pixel[3]).collect();
        Ok::<_, DrawError>((engine, alphas))
    };
    let Ok((engine, drawn)) = draw(first, DepthTest::Less) else {
        return Ok(0); // no depth buffer of 32 bits, or no method for the frame
    };
    match draw(second, DepthTest::LessOrEqual) {
        Ok((_, again)) if again == drawn => Ok(1),
        Err(DrawError::Refused(_)) => Ok(0),
        Ok((other, _)) if other != engine => Ok(0),
        Err(DrawError::DepthOfEngine(other)) if other == engine => {
            let own = Variant::parse(second.0).expect("a method");
            let by = own.plan(frame, second.1).renderer();
            let is_other = by.is_some_and(|by| by.engine() != engine);
            if is_other {
                Ok(0)
            } else {
                Err(format!("{first:?} and then {second:?}: refused"))
            }
        }
        found => Err(format!(
            "{first:?} and then {second:?}: the second pass is {:?}",
            found.map(|(engine, _)| engine)
        )),
    }
}
