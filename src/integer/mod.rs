//! Shading in integers, for processors without a floating-point unit: no allocator, no float, no
//! panic.
//!
//! Lecture 21 made Phong shading fast where a root and a division are dear. They are dear on
//! Cortex-M0, RV32IMC and soft cores, and there the lecture's order still holds: Gouraud's method
//! is cheapest, then [`quadratic`], then [`fast`], then [`naive`]. `docs/small.md` has the figures.
//!
//! ```
//! use fastphong::integer::{Light, Material, Reflection, Rgb565, Span, unit};
//! use fastphong::fixed::types::U16F16;
//!
//! // A material in the colour of its light: tables, made by the compiler, in read-only memory.
//! const fn grey(x: &str) -> [U16F16; 3] {
//!     [U16F16::lit(x); 3]
//! }
//! static CLAY: Material<Rgb565> = Material::new(grey("0.1"), grey("0.6"), grey("0.3"), 32);
//!
//! // Unit vectors: toward the light, toward the eye.
//! let light = Light::new(unit([1, 2, 3]), unit([0, 0, 1]), &CLAY);
//! // 32 pixels between two normals. The second one belongs to the pixel after the last.
//! let mut line = [Rgb565(0); 32];
//! let span = Span::new(unit([0, 0, 1]), unit([1, 0, 3]));
//! span.fast::<_, Reflection, false, 1>(&mut line, &[light]);
//! assert_ne!(line[0], line[31]);
//! ```
//!
//! # Parts
//!
//! - [`Pixel`] is a format of pixels: [`Rgb565`], [`Rgb565Be`], [`Rgb888`] or your own.
//! - [`Material`] holds two tables of 512 colours; [`Light`] joins it to directions.
//! - [`Span`] shades a line between two normals, by any method. [`gouraud`], [`naive`], [`fast`] and
//!   [`quadratic`] are the loops below it, for state that comes from elsewhere: they take any, but cut nothing, and
//!   where it leaves its ranges colours are wrong.
//! - [`Canvas`] draws triangles and convex polygons, with 16 bits of depth if you like.
//!
//! Methods have up to three parameters: the kind of highlight ([`Reflection`], [`Halfway`],
//! [`NoHighlight`]), whether a step of Newton's refines 1/√D after its table, and the number of lights,
//! one to four and more.
//!
//! # Formats
//!
//! | quantity | type | range | why it cannot overflow |
//! |---|---|---|---|
//! | vectors ([`Vector`]) | `I17F15` | length ≤ 1 + 2⁻¹⁴ | a dot product is at most 2³⁰ in 32 bits; a longer one is no `Vector` |
//! | J, K, N, D and their steps | `I2F30` | −1 to 1 | between its ends, or convex; drift < 2⁻¹¹ over [`Span::MAX`] pixels |
//! | 1/√D | 15 fractional bits | 1 to 2 | the table ends at 2; J/√D ≤ 255/256 as \|J\| ≤ √D 255/256 |
//! | 1/n | 15 bits and a shift | n ≤ 256 | times a difference below 4, in 14 bits: below 2³¹ |
//! | colours | fields of 9 or 10 bits and a guard | 0 to 1 | two sums stay below 2; then clamped |
//!
//! Sums are those of the types of [`fixed`]. Products are taken of their bits: the types' own products
//! go through 64 bits, which takes four times as long on a Cortex-M0.
//!
//! # Limits
//!
//! Lights and eye are at infinity. Normals are interpolated on the screen, as in the lecture: see
//! [`Canvas`] for the error that perspective makes. Neighbouring normals lie within 120° of one
//! another, for [`quadratic`] within some 15° and for [`Span::slerp`] within 90°: beyond that colours
//! are wrong, but nothing overflows or panics. Lines may have any length and vectors any components: see
//! [`Span::MAX`] and [`Vector`].

mod as_printed;
#[cfg(feature = "alloc")]
mod bound;
mod canvas;
mod fast;
mod gouraud;
mod gradients;
mod light;
mod material;
mod naive;
mod pixel;
mod quadratic;
mod ramp;
mod reciprocal;
mod reciprocal_root;
mod scan;
mod six_point;
mod slerp;
mod sliver;
mod span;
#[cfg(test)]
mod tests;
mod triangle;
mod vector;

#[cfg(feature = "alloc")]
pub use bound::ErrorBound;
pub use canvas::{Canvas, Vertex};
pub use fast::fast;
pub use gouraud::gouraud;
pub use light::{Halfway, Highlight, Light, NoHighlight, Reflection};
pub use material::Material;
pub use naive::{colour, naive};
pub use pixel::{Pixel, Rgb565, Rgb565Be, Rgb888};
pub use quadratic::quadratic;
pub use ramp::{Quadratic, Ramp};
pub use span::Span;
pub use vector::{Vector, unit};
