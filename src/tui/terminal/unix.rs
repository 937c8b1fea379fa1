//! What Unix alone has: signals, the stop of a job, a terminal that is a file.

use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::AsFd;
use std::sync::mpsc::Sender;
use std::thread;
use std::time::Duration;

use signal_hook::consts::signal::SIGXFSZ;
use signal_hook::consts::{
    SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1, SIGUSR2, SIGWINCH,
};
use signal_hook::iterator;

use super::event::Event;
use super::pacer::Pacer;
use super::{mouse, session};

/// Where the app draws: a handle of its own takes no lock, so a panic on any thread can write.
pub(super) type Out = File;

/// How long after a signal the app may take to leave by itself. A terminal that does not read holds
/// it up for ever.
const LAST_CALL: Duration = Duration::from_secs(2);

/// Opens what is drawn on.
///
/// # Errors
/// Where there is no terminal.
pub(super) fn out() -> io::Result<Out> {
    Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
}

/// Frames wait for replies: nobody knows how far the terminal is.
pub(super) fn pacer() -> Pacer {
    Pacer::default()
}

/// Has the terminal report its mouse, or no longer.
///
/// # Errors
/// Where the terminal is gone.
pub(super) fn listen_to_mouse(mut out: &Out, listen: bool) -> io::Result<()> {
    out.write_all(if listen { mouse::ON } else { mouse::OFF })
}

/// The signals that are listened to, from now on.
pub(super) struct Signals(iterator::Signals);

/// Listens to every signal that would end or stop the app and leave the terminal as it is.
///
/// # Errors
/// Where the system refuses.
pub(super) fn signals() -> io::Result<Signals> {
    let all = [
        SIGWINCH, SIGCONT, SIGXFSZ, SIGTERM, SIGINT, SIGQUIT, SIGHUP, SIGUSR1, SIGUSR2, SIGALRM,
    ];
    Ok(Signals(iterator::Signals::new(all)?))
}

/// Sends what is typed and which signals come.
pub(super) fn listen(send: &Sender<Event>, Signals(mut signals): Signals) {
    let sender = send.clone();
    thread::spawn(move || {
        let mut told = false;
        for signal in signals.forever() {
            let event = match signal {
                SIGCONT => Event::Continued,
                SIGWINCH => Event::Resized,
                // The write that went beyond the limit fails by itself, and that is shown.
                SIGXFSZ => continue,
                end => {
                    let code = 128 + end;
                    if told {
                        session::abandon(code);
                    }
                    told = true;
                    thread::spawn(move || {
                        thread::sleep(LAST_CALL);
                        session::abandon(code);
                    });
                    Event::End(u8::try_from(code).unwrap_or(1))
                }
            };
            if sender.send(event).is_err() {
                return;
            }
        }
    });
    let sender = send.clone();
    thread::spawn(move || read_keyboard(&sender));
}

fn read_keyboard(send: &Sender<Event>) {
    let mut keyboard = io::stdin().lock();
    let mut bytes = [0; 4096];
    loop {
        let event = match keyboard.read(&mut bytes) {
            Ok(0) => Event::HANGUP,
            Ok(count) => Event::Bytes(bytes[..count].to_vec()),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(_) => Event::HANGUP,
        };
        let over = event.is_end();
        if send.send(event).is_err() || over {
            return;
        }
    }
}

/// Stops the process until the shell goes on with it.
///
/// # Errors
/// Where the system refuses.
pub(super) fn stop() -> io::Result<()> {
    signal_hook::low_level::raise(SIGTSTP)
}
