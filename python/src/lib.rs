//! fastphong for Python: the extension module behind `fastphong/__init__.py`.
//!
//! `fastphong/_meshes.py` checks and packs arrays, which arrive here as bytes. Pictures are drawn
//! into byte arrays that numpy then wraps, so no pixel is copied. The keys of a scene arrive as
//! TOML, as in a scene file, and the crate checks them. Python's lock is released for everything
//! that takes time.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(clippy, deny(warnings))]

mod errors;
mod mesh;
mod method;
mod picture;
mod pool;
mod scene;
mod settings;

use pyo3::prelude::*;

#[pymodule]
mod _fastphong {
    #[pymodule_export]
    use super::mesh::{Mesh, vertex_normals};
    #[pymodule_export]
    use super::method::methods;
    #[pymodule_export]
    use super::picture::{difference, difference_map, encode_png, read_picture, write_picture};
    #[pymodule_export]
    use super::scene::Scene;
}
