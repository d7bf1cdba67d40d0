/** Topics as the dashboard reads them: one consumer per topic, the newest state, history and density. */
package io.furrow.dashboard.feed;
