//! The names that most figures import: to draw, to measure and to show.

pub(super) use super::Figure;
pub(super) use super::content::{Agreement, FigureContent, Plot, Series, linear, log, written};
pub(super) use super::error::{FigureError, Result};
pub(super) use super::fixture::*;
pub(super) use super::handle::{Handle, Live};
pub(super) use super::measure::*;
pub(super) use alloc::{format, string::String, vec, vec::Vec};
pub(super) use fastphong::compare::metrics::{compare, difference_map};
pub(super) use fastphong::frame::Frame;
pub(super) use fastphong::mesh::Material;
pub(super) use fastphong::mesh::vertex_normals::NormalSource;
pub(super) use fastphong::number::vec3;
pub(super) use fastphong::picture::LinearPicture;
pub(super) use fastphong::scene::{
    Camera, Falloff, Interpolation, Light, Lighting, Projection, Scene, SpecularGate, SpecularModel,
};
pub(super) use fastphong::shading::{Variant, Walk};
pub(super) use glam::{DAffine3, DVec2, DVec3};
