//! A program with only fast Phong and Gouraud shading, to see how much flash it needs.
#![cfg_attr(target_os = "none", no_std, no_main)]

mod machine;

use fastphong::fixed::types::U16F16;
use fastphong::integer::{Light, Material, Reflection, Rgb565, Span, colour, gouraud, unit};
use machine::{Line, Memory, NOTHING, checksum, end, start_counting, stop_counting, write_count};

const fn grey(x: &str) -> [U16F16; 3] {
    [U16F16::lit(x); 3]
}
static CLAY: Material<Rgb565> = Material::new(grey("0.1"), grey("0.6"), grey("0.3"), 32);

static LINE: Memory<[Rgb565; 240]> = Memory::new([Rgb565(0); 240]);

fn shade() {
    let Some(line) = LINE.take() else {
        return;
    };
    let light = [Light::new(unit([1, 2, 3]), unit([0, 0, 1]), &CLAY)];
    start_counting();
    let (from, to) = (unit([0, 0, 1]), unit([1, 0, 3]));
    Span::new(from, to).fast::<_, Reflection, false, 1>(line, &light);
    let mut sum = line
        .iter()
        .fold(NOTHING, |sum, pixel| checksum(sum, u32::from(pixel.0)));
    let of = |normal| colour::<_, Reflection, 1>(&light, normal);
    gouraud(line, of(from), of(to));
    stop_counting();
    sum = line
        .iter()
        .fold(sum, |sum, pixel| checksum(sum, u32::from(pixel.0)));
    write_count();
    Line::new().text("least ").number(sum).print();
}

#[cfg(target_os = "none")]
#[unsafe(no_mangle)]
extern "C" fn run() -> ! {
    shade();
    end(true)
}

#[cfg(not(target_os = "none"))]
fn main() {
    shade();
    end(true)
}
