//! Compares the documents with the code.

mod course;
mod findings;
mod flags;
mod lectures;
mod live;
mod markdown;
mod meshes;
mod methods;
mod mistakes;
mod rooms;
mod small;
mod tidy;
