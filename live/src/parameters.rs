//! Lists the parameters of a method, from which the page makes handles.

use crate::studio::Studio;
use fastphong::scene::Power;
use fastphong::shading::{Range, Variant};
use serde_json::{Value, json};

impl Studio {
    pub fn parameters(&mut self) -> Result<usize, String> {
        let variant = Variant::parse(&self.told()).map_err(|error| error.to_string())?;
        let given = variant.info().parameters.iter().zip(variant.parameters());
        let given = given.map(|(parameter, value)| {
            let values = match parameter.range {
                Range::Whole(least, most) => json!({ "range": [least, most], "whole": true }),
                Range::Decimal(least, most) => json!({ "range": [least, most] }),
                Range::Words(words) => json!({ "words": words }),
            };
            json!({
                "name": parameter.name, "meaning": parameter.meaning, "value": parameter.text(*value),
                "auto": parameter.auto.is_some(), "values": values,
            })
        });
        let mut all: Vec<Value> = given.collect();
        if variant.info().has_power {
            let words = Power::ALL.map(|power| power.name());
            all.push(json!({
                "name": "power", "meaning": "the power function of highlights", "value": variant.power().name(),
                "auto": false, "values": { "words": words },
            }));
        }
        Ok(self.say(Value::from(all).to_string()))
    }
}
