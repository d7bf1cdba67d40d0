/** The job replay while its task manager is killed and its replays are steered: what its topics hold by epoch. */
package io.furrow.soak.replay;
