//! Pins pictures to the bit: stores a checksum of the linear picture of every shipped scene, by
//! every method and engine, and by the reference and CS171.
//!
//! `tests/pins.txt` holds the checksums. The regression tests beside this file let a channel differ
//! by one level. Here no bit may differ. If a change is intended, look at the pictures, bless the
//! pins with `FASTPHONG_BLESS=1 cargo test --test conformance pins`, and name the change as
//! CONTRIBUTING.md says.
//!
//! Every engine draws the same bits on every machine, and the row engine on every instruction set
//! that it supports. A machine without one of these sets does not change the pins of the row
//! engine.

use crate::support::cases::{Case, cases};
use crate::support::drawings::for_each_drawing;
use crate::support::floats_on;
use fastphong::frame::triangulate::triangulated;
use fastphong::picture::LinearPicture;
use fastphong::raster::{Edges, Renderer};
use fastphong::reference::Model;
use fastphong::reference::cs171::{self, Reading, Shading};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::{env, fs};

/// The checksum of each picture, by `scene method engine`.
type Pins = BTreeMap<String, u64>;

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/pins.txt")
}

fn read() -> Pins {
    let text = fs::read_to_string(file()).unwrap_or_default();
    let pin = |line: &str| {
        let (sum, name) = line.split_once(' ').expect("a checksum and a name");
        let sum = u64::from_str_radix(sum, 16).expect("a hexadecimal checksum");
        (name.to_string(), sum)
    };
    text.lines().map(pin).collect()
}

fn write(pins: &Pins) {
    let lines = pins
        .iter()
        .map(|(name, sum)| format!("{sum:016x} {name}\n"));
    fs::write(file(), lines.collect::<String>()).expect("a writable file of pins");
}

/// Returns the 64-bit FNV-1a hash of the bytes of all channels.
fn checksum<const BYTES: usize>(channels: impl Iterator<Item = [u8; BYTES]>) -> u64 {
    channels
        .flatten()
        .fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
        })
}

fn of_linear(picture: &LinearPicture) -> u64 {
    let channels = picture.pixels().as_flattened().iter();
    checksum(channels.map(|c| c.to_le_bytes()))
}

/// Draws `case` by the barycentric renderer, CS171 and the reference, which do not depend on
/// instruction sets.
fn drawn_alike(case: &Case) -> Pins {
    let (frame, mut pins) = (&case.frame, Pins::new());
    let mut pin = |method: &str, by: &str, sum: u64| {
        let name = format!("{} {method} {by}", case.name);
        assert_eq!(pins.insert(name, sum), None, "{method} by {by} twice");
    };
    let triangles = triangulated(frame).frame;
    for variant in floats_on(frame).map(|entry| entry.variant()) {
        let method = variant.info().name;
        if let Some(picture) = variant.render_barycentric_linear(&triangles, Edges::TopLeft) {
            pin(method, "barycentric", of_linear(&picture));
        }
    }
    for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
        let reading = Reading {
            cull: false,
            ..Reading::default()
        };
        let picture =
            cs171::render(&triangles, shading, reading).filtered(frame.samples(), frame.alpha());
        let channels = picture.pixels().as_flattened().iter();
        pin(
            &format!("{shading:?}").to_lowercase(),
            "cs171",
            checksum(channels.map(|c| c.to_le_bytes())),
        );
    }
    for model in Model::ALL {
        pin(model.name(), "reference", of_linear(case.truth(model)));
    }
    pins
}

#[test]
fn pictures_are_pinned_to_the_bit() {
    let pinned = read();
    let size = Some((128, 96));
    let mut all: Pins = cases(size).flat_map(drawn_alike).collect();
    let drawn = for_each_drawing(cases(size), |drawing| {
        let (case, engine) = (&drawing.case.name, drawing.renderer.engine().name());
        let name = format!("{case} {} {engine}", drawing.variant.info().name);
        (name, of_linear(&drawing.linear()), drawing.to_string())
    });
    let mut changed = Vec::new();
    for (name, sum, drawing) in drawn {
        // All instruction sets of the row engine share one pin.
        if *all.entry(name).or_insert(sum) != sum {
            changed.push(format!("{drawing}: not as on another instruction set"));
        }
    }
    let has_rows = Renderer::fastest() != Renderer::LECTURE;
    let is_drawn_here = |name: &str| has_rows || !name.ends_with(" row");
    if env::var_os("FASTPHONG_BLESS").is_some() && changed.is_empty() {
        let elsewhere = pinned.into_iter().filter(|(name, _)| !is_drawn_here(name));
        return write(&elsewhere.chain(all).collect());
    }
    for (name, sum) in &all {
        match pinned.get(name) {
            Some(pin) if pin == sum => {}
            Some(_) => changed.push(format!("{name}: changed")),
            None => changed.push(format!("{name}: not pinned")),
        }
    }
    let is_stale = |name: &&String| !all.contains_key(*name) && is_drawn_here(name);
    let stale = pinned.keys().filter(is_stale);
    changed.extend(stale.map(|name| format!("{name}: no longer drawn")));
    assert!(
        changed.is_empty(),
        "{} of {} pictures:\n{}",
        changed.len(),
        all.len(),
        changed.join("\n")
    );
}
