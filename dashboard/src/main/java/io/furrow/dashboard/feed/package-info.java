/** Topics as the dashboard reads them: one consumer per topic, initial state, history and density. */
package io.furrow.dashboard.feed;
