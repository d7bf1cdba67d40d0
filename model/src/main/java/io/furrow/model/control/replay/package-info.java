/** Commands and state of replays. */
package io.furrow.model.control.replay;
