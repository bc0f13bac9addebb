//! Pins pictures to the bit: a checksum of the linear picture of every shipped scene, by every method, engine and
//! instruction set, and by the reference and CS171.
//!
//! `tests/pins.txt` holds them. The regression tests beside this one let a channel differ by one level; here nothing may. If a
//! change is meant, look at the pictures, bless the pins with `FASTPHONG_BLESS=1 cargo test --test conformance pins`, and name
//! the change in CHANGELOG.md under *Pixels changed*.
//!
//! The span engine, the barycentric renderer, CS171 and the reference draw the same bits on every machine. The row engine's
//! pictures differ by instruction set; those of [`ESTIMATING`] methods also by how a processor estimates 1/√x. Pins of other
//! instruction sets and processors than this machine's are kept as they are.

use crate::support::cases::{Case, cases};
use crate::support::drawings::for_each_drawing;
use crate::support::floats_on;
use fastphong::frame::triangulate::triangulated;
use fastphong::number::Level;
use fastphong::number::simd::rsqrt_checksum;
use fastphong::picture::LinearPicture;
use fastphong::raster::{Edges, Renderer};
use fastphong::reference::Model;
use fastphong::reference::cs171::{self, Reading, Shading};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::{env, fs};

/// Methods whose row kernels start from the processor's estimate of 1/√x.
const ESTIMATING: [&str; 2] = ["phong-rsqrt", "fast-phong-rsqrt"];

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

/// Returns the name of `renderer` in pins of `method`, with the processor's estimate where the method takes it.
fn renderer_name(method: &str, renderer: Renderer) -> String {
    let level = renderer.level();
    match rsqrt_checksum(level) {
        _ if level == Level::Scalar => "span".into(),
        Some(sum) if ESTIMATING.contains(&method) => format!("{level} estimate {sum:016x}"),
        _ => level.to_string(),
    }
}

/// Draws `case` by the barycentric renderer, CS171 and the reference, which are the same on every machine.
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
        let picture = cs171::render(&triangles, shading, reading);
        let picture = picture.filtered(frame.samples(), frame.alpha());
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
        let method = drawing.variant.info().name;
        let by = renderer_name(method, drawing.renderer);
        let name = format!("{} {method} {by}", drawing.case.name);
        (name, of_linear(&drawing.linear()))
    });
    for (name, sum) in drawn {
        assert_eq!(all.insert(name.clone(), sum), None, "{name} twice");
    }
    if env::var_os("FASTPHONG_BLESS").is_some() {
        // What no machine can draw any more goes; what other machines draw stays.
        let is_elsewhere = |name: &str| {
            let has = |level: &Level| name.contains(&format!(" {level}"));
            let is_other_processor = name.contains(" estimate ");
            Level::ALL
                .iter()
                .any(|l| has(l) && (!l.is_available() || is_other_processor))
        };
        let elsewhere = pinned.into_iter().filter(|(name, _)| is_elsewhere(name));
        return write(&elsewhere.chain(all).collect());
    }
    let is_known_processor = |name: &str| {
        let processor = name.split_once(" estimate ").map(|(_, sum)| sum);
        processor.is_none_or(|sum| pinned.keys().any(|name| name.ends_with(sum)))
    };
    let mut changed = Vec::new();
    for (name, sum) in all.iter().filter(|(name, _)| is_known_processor(name)) {
        match pinned.get(name) {
            Some(pin) if pin == sum => {}
            Some(_) => changed.push(format!("{name}: changed")),
            None => changed.push(format!("{name}: not pinned")),
        }
    }
    let is_stale = |name: &&String| {
        let on_every_machine = [" span", " barycentric", " cs171", " reference"];
        !all.contains_key(*name) && on_every_machine.iter().any(|end| name.ends_with(end))
    };
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
