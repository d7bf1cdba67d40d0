/** Replays as a Flink source: each replay is a split, whose desired state the enumerator sends. */
package io.furrow.replay.source;
