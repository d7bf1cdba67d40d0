/** Replays as a source of Flink: each replay is a split, what is requested of it comes from the enumerator. */
package io.furrow.replay.source;
