/** Checks the topics of replays by epoch, while the job's task manager is killed and its replays receive commands. */
package io.furrow.soak.replay;
