//! The engines: they own the loops, and know nothing of lights.
//!
//! - [`scanline`] is the lecture's: an edge table, active edges that step their attributes from scanline to scanline,
//!   a depth buffer of one line, and visible runs that are walked and shaded once.
//! - [`barycentric`] is what it is measured against: a bounding box a triangle, three edge functions a pixel.
//!
//! Both draw exactly the same pixels: those whose centres have an odd number of polygon edges to their left, counted in
//! exact integers on corners snapped to 1/256 pixel. Polygons that share an edge share none of its pixels and leave no
//! hole.

mod active;
mod aov;
mod bands;
pub mod barycentric;
mod barycentric_numbers;
mod bins;
mod depth;
mod edge;
mod edge_table;
mod engine;
mod interpolated;
pub(crate) mod rows;
pub mod scanline;
mod setup;
mod sink;
mod supersampling;
mod target;
mod visibility;

pub use aov::{coverage, depth, normals, polygon_numbers};
pub use barycentric::Edges;
pub use barycentric_numbers::barycentric_polygon_numbers;
pub use edge::Crossing;
pub use engine::{Engine, Plan, Renderer};
pub use interpolated::{
    barycentric_checkerboard, barycentric_vertex_colours, checkerboard, vertex_colours,
};
pub use visibility::NOTHING;

pub(crate) use bands::{Bands, PictureBands, StreamedBands};
pub(crate) use supersampling::{draw_anyhow, draw_rows};
pub(crate) use target::{Target, Texel, clear, linear_picture, picture8};
