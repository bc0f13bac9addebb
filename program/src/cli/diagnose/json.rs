//! The answer as data.

use super::DiagnoseArgs;
use crate::diagnose::{Cause, Diagnosis, Numbers, scenes_that_show};
use fastphong::scene::Scene;
use serde_json::{Value, json};
use std::time::Duration;

/// Returns the answer as JSON.
pub fn json(args: &DiagnoseArgs, scene: &Scene, found: &Diagnosis, time: Duration) -> Value {
    let before = found.reference.levels;
    let cause = |cause: &Cause| {
        let ids: Vec<&str> = cause.mistakes.iter().map(|mistake| &*mistake.id).collect();
        let made = cause.mistakes.iter().map(|mistake| {
            json!({ "id": mistake.id, "text": mistake.text, "fix": mistake.fix, "see": mistake.see })
        });
        json!({
            "ids": ids,
            "mistakes": made.collect::<Value>(),
            "residual": cause.residual,
            "steps": cause.steps.iter().map(|step| step.left).collect::<Value>(),
            "explained": 1.0 - cause.residual / before,
        })
    };
    let left = found
        .singles
        .iter()
        .map(|single| json!({ "id": single.mistakes[0].id, "residual": single.residual }));
    let invisible = found.invisible.iter().map(|mistake| {
        let scenes = scenes_that_show(&mistake.id);
        let scenes: Vec<&str> = scenes.iter().map(|(scene, _)| *scene).collect();
        json!({ "id": mistake.id, "scenes": scenes })
    });
    json!({
        "schema": "fastphong.diagnose/2",
        "picture": args.picture.display().to_string(),
        "scene": args.input,
        "method": args.method.as_ref().map(ToString::to_string),
        "width": scene.width,
        "height": scene.height,
        "correct": found.is_correct(),
        "verdict": found.verdict.name(),
        "residual": before,
        "compared": found.reference.compared,
        "left_out": found.reference.left_out,
        "polygons": found.cut,
        "causes": found.causes.iter().map(cause).collect::<Value>(),
        "singles": left.collect::<Value>(),
        "votes": found.votes.map(|votes| json!({
            "voters": votes.voters, "nearer": votes.nearer, "explained": votes.explained,
        })),
        "numbers": found.numbers.as_ref().map(numbers),
        "tone": found.tone.map(|tone| json!({ "gamma": tone.gamma, "scatter": tone.scatter })),
        "transposed": found.is_transposed,
        "window": found.window.map(|window| json!({
            "in_picture": window.in_file, "in_scene": window.in_scene, "size": window.size,
        })),
        "rows": found.rows.map(|rows| json!({
            "longer": rows.longer, "pixel_bytes": rows.bytes, "order": rows.order.name(),
        })),
        "background": found.background.map(|[yours, scene]| json!({ "yours": yours, "scene": scene })),
        "stated_encoding": found.stated_encoding,
        "premultiplied": found.is_premultiplied,
        "outline": found.outline,
        "cracks": found.cracks,
        "look_at": found.look_at.map(|spot| json!({
            "x": spot.pixel[0], "y": spot.pixel[1], "yours": spot.yours,
            "reference": spot.reference, "explained": spot.explained,
        })),
        "worst": found.worst.map(|[x, y, width, height]| json!({
            "x": x, "y": y, "width": width, "height": height,
        })),
        "cannot_show": invisible.collect::<Value>(),
        "seconds": time.as_secs_f64(),
    })
}

fn numbers(numbers: &Numbers) -> Value {
    let lights = numbers.lights.iter().map(|light| {
        json!({
            "index": light.index, "local": light.is_local, "stated": light.stated.to_array(),
            "fitted": light.fitted.to_array(), "off": light.off, "name": light.name,
        })
    });
    let amounts = numbers.amounts.iter().map(|amount| {
        json!({
            "term": amount.term, "light": amount.light, "material": amount.material,
            "channel": amount.channel, "factor": amount.factor, "added": amount.is_added,
            "diffuse_hue": amount.has_diffuse_hue,
        })
    });
    let ids: Vec<&str> = numbers
        .mistakes
        .iter()
        .map(|mistake| &*mistake.id)
        .collect();
    json!({
        "ids": ids,
        "lights": lights.collect::<Value>(),
        "exponent": numbers.exponent,
        "fog": numbers.fog.map(|fog| json!({ "density": fog.density, "colour": fog.colour })),
        "amounts": amounts.collect::<Value>(),
        "residual": numbers.residual,
    })
}
