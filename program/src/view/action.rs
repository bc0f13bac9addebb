//! Keys and their actions.

use std::f64::consts::PI;

/// An action that a key triggers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Show another method on the side of the pointer, or on the other side.
    Method {
        /// The index in the list of methods.
        index: usize,
        /// True for the side that the pointer is not on.
        other: bool,
    },
    /// Turn the camera by an azimuth and an elevation, in radians.
    Turn(f64, f64),
    /// Enlarge the view by a factor.
    Zoom(f64),
    /// Move the divider to the right by a fraction of the width.
    Divide(f64),
    /// Exchange left and right.
    Swap,
    /// Show both methods, then only the left one, then only the right one.
    ShowNext,
    /// Switch between lights that turn with the eye and lights that stay in the world.
    CarryLights,
    /// Return to the scene's own camera.
    Reset,
    /// Close the window.
    Close,
}

/// The angle of an arrow key, in radians: 24 steps are half a turn.
const STEP: f64 = PI / 24.0;

impl Action {
    /// The keys, as printed when the window opens.
    pub const KEYS: &str = "drag or arrows turn, wheel or +/- zoom, drag the line or Shift+arrows move it; Space shows one, Tab swaps, \
                            L carries lights along, Home resets, Esc closes";

    /// Returns the action of a key, or `None` if it has none. `code` is the position of the key on
    /// the keyboard, named as in UI Events (`KeyboardEvent.code`,
    /// <https://www.w3.org/TR/uievents-code/>). Positions do not depend on the layout; with
    /// characters, some layouts would need Shift for digits.
    pub fn of_key(code: &str, shift: bool) -> Option<Action> {
        let digit = code
            .strip_prefix("Digit")
            .or_else(|| code.strip_prefix("Numpad"));
        if let Some(digit @ 1..=9) = digit.and_then(|digit| digit.parse().ok()) {
            return Some(Action::Method {
                index: digit - 1,
                other: shift,
            });
        }
        Some(match code {
            "ArrowLeft" if shift => Action::Divide(-0.05),
            "ArrowRight" if shift => Action::Divide(0.05),
            "ArrowLeft" => Action::Turn(-STEP, 0.0),
            "ArrowRight" => Action::Turn(STEP, 0.0),
            "ArrowUp" => Action::Turn(0.0, STEP),
            "ArrowDown" => Action::Turn(0.0, -STEP),
            "Equal" | "NumpadAdd" => Action::Zoom(1.1),
            "Minus" | "NumpadSubtract" => Action::Zoom(1.0 / 1.1),
            "Space" => Action::ShowNext,
            "Tab" => Action::Swap,
            "KeyL" => Action::CarryLights,
            "Home" | "KeyR" => Action::Reset,
            "Escape" | "KeyQ" => Action::Close,
            _ => return None,
        })
    }

    /// True if holding the key repeats the action.
    pub fn repeats(self) -> bool {
        matches!(self, Action::Turn(..) | Action::Zoom(_) | Action::Divide(_))
    }
}

#[cfg(test)]
mod tests {
    use super::Action;

    #[test]
    fn digits_choose_methods_in_order_on_both_blocks_of_the_keyboard() {
        for index in 0..9 {
            for block in ["Digit", "Numpad"] {
                for other in [false, true] {
                    let key = Action::of_key(&std::format!("{block}{}", index + 1), other);
                    assert_eq!(key, Some(Action::Method { index, other }));
                }
            }
        }
        for code in ["Digit0", "Numpad0", "NumpadEnter", "Digit10", "KeyA", ""] {
            assert_eq!(Action::of_key(code, false), None, "{code}");
        }
    }

    #[test]
    fn opposite_keys_undo_each_other() {
        let key = |code| Action::of_key(code, false).expect("a key");
        assert_eq!(key("ArrowLeft"), Action::Turn(-super::STEP, 0.0));
        assert_eq!(key("ArrowRight"), Action::Turn(super::STEP, 0.0));
        assert_eq!(key("NumpadAdd"), key("Equal"));
        let (Action::Zoom(nearer), Action::Zoom(farther)) = (key("Equal"), key("Minus")) else {
            panic!("they zoom");
        };
        // One rounding of a quotient, one of a product.
        assert!((nearer * farther - 1.0).abs() < 4.0 * f64::EPSILON);
        assert_eq!(
            Action::of_key("ArrowLeft", true),
            Some(Action::Divide(-0.05))
        );
    }
}
