//! Random worlds: scenes that nobody thought of, and the properties that must hold in all of them
//! (`properties.rs`).
//!
//! `cargo test --test worlds` tries a few hundred worlds, always the same ones. This command tries
//! more:
//!
//! ```sh
//! FASTPHONG_WORLDS=100000 cargo test --release --test worlds -- --nocapture
//! ```
//!
//! and `FASTPHONG_WORLDS_SEED=2` tries others. The first worlds are written to `target/tmp/worlds`,
//! where the tests of the Python package find them. If a property does not hold in a world, the
//! test makes the world as small as possible and prints it as the files of a scene. Make a test
//! from these files, and let its name say the situation.

mod builders;
mod doors;
mod files;
mod mesh;
mod numbers;
mod passes;
mod properties;
mod scene;
mod wild;
mod world;

#[path = "../conformance/support/renderers.rs"]
#[allow(dead_code)] // conformance uses more of it
mod renderers;

use doors::Outcome;
use properties::{Tally, check};
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use std::cell::{Cell, RefCell};
use std::fmt::Debug;
use std::fs;
use std::path::Path;
use world::World;

/// How many worlds a test run tries, unless the environment asks for more.
const WORLDS: u32 = 600;

/// How many worlds come from one seed. After a failure the test goes on with the next block.
const BLOCK: u32 = 100;

/// Returns a number from an environment variable.
fn setting(name: &str, default: u32) -> u32 {
    match std::env::var(name) {
        Ok(text) => text
            .parse()
            .unwrap_or_else(|_| panic!("{name} is `{text}`: expected a whole number")),
        Err(_) => default,
    }
}

/// Tries worlds in blocks, each with its own seed. Returns a message for each block that fails,
/// with the smallest input found for which `test` fails, and the reason.
fn try_all<S: Strategy>(
    inputs: &S,
    count: u32,
    test: impl Fn(S::Value) -> Result<(), String>,
) -> Vec<String>
where
    S::Value: Debug,
{
    let seed = setting("FASTPHONG_WORLDS_SEED", 1);
    let blocks = (0..count.div_ceil(BLOCK)).filter_map(|block| {
        let mut bytes = [0; 32];
        bytes[..4].copy_from_slice(&seed.to_le_bytes());
        bytes[4..8].copy_from_slice(&block.to_le_bytes());
        let config = Config {
            cases: BLOCK.min(count - block * BLOCK),
            failure_persistence: None,
            max_shrink_iters: 2000,
            ..Config::default()
        };
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
        let mut runner = TestRunner::new_with_rng(config, rng);
        let tried = runner.run(inputs, |input| test(input).map_err(TestCaseError::fail));
        let failure = match tried {
            Ok(()) => return None,
            Err(TestError::Fail(reason, input)) => format!("{reason}\n{input:?}"),
            Err(TestError::Abort(reason)) => format!("gave up: {reason}"),
        };
        println!("block {block}: {failure}");
        Some(failure)
    });
    blocks.collect()
}

fn assert_none(failures: &[String]) {
    let count = failures.len();
    assert!(
        count == 0,
        "{count} blocks of worlds fail, for example: {}",
        failures[0]
    );
}

/// How many worlds are written down for the tests of other packages.
const WRITTEN: u32 = 200;

/// Writes a world to a numbered folder.
fn write(number: u32, world: &World) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("worlds/{number}"));
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    for (name, text) in world.files() {
        fs::write(folder.join(name), text).expect("the target folder can be written to");
    }
}

#[test]
fn everything_holds_in_random_worlds() {
    let worlds = setting("FASTPHONG_WORLDS", WORLDS);
    let tally = RefCell::new(Tally::default());
    let written = Cell::new(0);
    let failures = try_all(&scene::worlds(), worlds, |world: World| {
        if written.get() < WRITTEN {
            write(written.get(), &world);
            written.set(written.get() + 1);
        }
        let Ok(scene) = world.scene() else {
            tally.borrow_mut().refused += 1;
            return Ok(());
        };
        *tally.borrow_mut() += check(&scene)?;
        Ok(())
    });
    let tally = tally.into_inner();
    println!("{worlds} worlds: {tally:?}");
    assert_none(&failures);
    // If most worlds were refused or empty, the properties would hold whatever the code does.
    let worlds = worlds as usize;
    assert!(tally.refused * 5 < worlds, "{tally:?}");
    assert!(tally.seen * 2 > worlds, "{tally:?}");
    assert!(tally.pixels_in_bound > 200 * worlds, "{tally:?}");
    assert!(tally.simple_polygons > worlds, "{tally:?}");
    assert!(tally.second_passes > worlds, "{tally:?}");
}

/// Numbers that are not finite, overflow or vanish must lead to an error or a picture.
#[test]
fn no_number_in_a_scene_makes_it_panic() {
    let worlds = setting("FASTPHONG_WORLDS", WORLDS);
    let drawn = Cell::new(0);
    let failures = try_all(&wild::changed_worlds(), worlds, |(world, changes)| {
        if let Ok(scene) = world.scene() {
            drawn.set(drawn.get() + u32::from(wild::draw(scene, &changes)));
        }
        Ok(())
    });
    println!("{worlds} worlds, {} of them drawn", drawn.get());
    assert_none(&failures);
    assert!(drawn.get() * 5 > worlds, "{} are drawn", drawn.get());
}

/// A caller cannot set anything that a scene file or a flag may not say, and both draw equal scenes
/// alike.
#[test]
fn both_doors_refuse_and_draw_the_same_scenes() {
    let worlds = setting("FASTPHONG_WORLDS", WORLDS);
    let outcomes = RefCell::new(Vec::new());
    let failures = try_all(&doors::made(), worlds, |(world, changes, lengths)| {
        if let Ok(scene) = world.scene() {
            outcomes
                .borrow_mut()
                .push(doors::check(scene, &changes, &lengths)?);
        }
        Ok(())
    });
    let outcomes = outcomes.into_inner();
    let count = |which| outcomes.iter().filter(|outcome| **outcome == which).count();
    let [refused, drawn, equal] = [Outcome::Refused, Outcome::Drawn, Outcome::Equal].map(count);
    println!("{worlds} worlds: {refused} refused, {drawn} drawn, {equal} equal to the bit");
    assert_none(&failures);
    let worlds = worlds as usize;
    assert!(10 * refused > worlds && 2 * equal > worlds);
}

/// A program may build frames of any values: polygons of up to 200 corners, vertices on the screen
/// and in clip space, lights and eyes anywhere, pictures of one pixel.
#[test]
fn no_frame_that_a_program_builds_makes_it_panic() {
    let frames = 2 * setting("FASTPHONG_WORLDS", WORLDS);
    let drawn = Cell::new(0);
    let failures = try_all(&builders::choices(), frames, |numbers| {
        drawn.set(drawn.get() + u32::from(builders::draw(&numbers)?));
        Ok(())
    });
    println!("{frames} frames, {} of them drawn", drawn.get());
    assert_none(&failures);
    assert!(drawn.get() * 8 > frames, "{} are drawn", drawn.get());
}
