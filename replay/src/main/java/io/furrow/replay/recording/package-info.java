/** Opens the recordings of replays and bounds the memory of their pages. */
package io.furrow.replay.recording;
