//! The whole path from random values to pixels, through every method and engine.
//!
//! The first eight bytes choose a random world (`tests/worlds`). Each ten bytes behind them replace
//! one of its values: two bytes say which one, and eight are the bits of the new value, which may
//! be anything. An unchanged world must have all properties of `tests/worlds/properties.rs`. A
//! changed world has values that no reader of files has checked, and must only not panic.

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

#[path = "../../tests/worlds/mesh.rs"]
mod mesh;
#[path = "../../tests/worlds/numbers.rs"]
mod numbers;
#[path = "../../tests/worlds/passes.rs"]
mod passes;
#[path = "../../tests/worlds/properties.rs"]
#[allow(dead_code)] // the worlds' tests use more of it
mod properties;
#[path = "../../tests/conformance/support/renderers.rs"]
#[allow(dead_code)] // conformance uses more of it
mod renderers;
#[path = "../../tests/worlds/scene.rs"]
mod scene;
#[path = "../../tests/worlds/wild.rs"]
mod wild;
#[path = "../../tests/worlds/world.rs"]
mod world;

/// The most values that an input replaces. The rest of its bytes is ignored.
const MOST_CHANGES: usize = 64;

pub fn run(bytes: &[u8]) {
    let Some((seed, changes)) = bytes.split_first_chunk::<8>() else {
        return;
    };
    let changes: Vec<wild::Change> = changes
        .as_chunks::<10>()
        .0
        .iter()
        .take(MOST_CHANGES)
        .map(|[low, high, bits @ ..]| {
            (u16::from_le_bytes([*low, *high]), f64::from_le_bytes(*bits))
        })
        .collect();
    let mut long_seed = [0; 32];
    long_seed[..8].copy_from_slice(seed);
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &long_seed);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let Ok(tree) = scene::worlds().new_tree(&mut runner) else {
        return;
    };
    let world = tree.current();
    let Ok(scene) = world.scene() else { return };
    if !changes.is_empty() {
        wild::draw(scene, &changes);
    } else if let Err(why) = properties::check(&scene) {
        panic!("{why}\n{world:?}");
    }
}
