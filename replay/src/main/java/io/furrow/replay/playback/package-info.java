/** The rules of when the events of a replay are due, without a clock, a thread or Flink. */
package io.furrow.replay.playback;
