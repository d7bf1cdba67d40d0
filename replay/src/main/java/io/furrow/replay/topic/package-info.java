/** The topics of replays: creates and watches them, and reads their ends. */
package io.furrow.replay.topic;
