/** The analytics jobs that belong to replays: started, ended and shown together with them. */
package io.furrow.launcher.replay;
