/** The topics that replays are played on: made, watched, and read at their end. */
package io.furrow.replay.topic;
