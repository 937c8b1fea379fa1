//! The app: its screens, and how it behaves in a terminal, over ssh and for guests.
#![cfg(feature = "app")]

mod bare_host;
mod guest;
mod guide;
mod leaving;
mod monkey;
mod one_answer;
mod over_ssh;
mod saving;
mod screens;
mod terminal;
mod wire;

mod made_up_accuracy;
mod ssh;

#[path = "../support/dice.rs"]
mod dice;
#[path = "../support/made_up.rs"]
mod made_up;
#[path = "../support/program.rs"]
mod program;
#[path = "../support/pty.rs"]
mod pty;
#[path = "../support/renew.rs"]
mod renew;
#[path = "../support/skip.rs"]
mod skip;
