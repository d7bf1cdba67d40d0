/** Where the recordings of replays are, and how much of them is held at a time. */
package io.furrow.replay.recording;
