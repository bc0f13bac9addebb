//! fastphong for Python: the extension module behind `fastphong/__init__.py`.
//!
//! `fastphong/_meshes.py` checks and packs arrays, which arrive here as bytes. The keys of a scene
//! arrive as TOML, as in a scene file, and the crate checks them. Everything that takes time runs
//! on threads of its own, on values that it owns, without Python's lock: [`pool::run`]. So Ctrl-C
//! need not wait for it, and a fork finds no lock taken. A picture is copied once, into a byte
//! array that numpy wraps.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(clippy, deny(warnings))]

mod errors;
mod inputs;
mod mesh;
mod method;
mod picture;
mod pool;
mod scene;
mod settings;
mod stored;

use pyo3::prelude::*;

#[pymodule]
mod _fastphong {
    #[pymodule_export]
    use super::mesh::{Mesh, vertex_normals};
    #[pymodule_export]
    use super::method::methods;
    #[pymodule_export]
    use super::picture::{Comparison, Image};
    #[pymodule_export]
    use super::scene::Scene;
}
