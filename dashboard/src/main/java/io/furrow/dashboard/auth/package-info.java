/** Users of the dashboard, as known to the control plane. */
package io.furrow.dashboard.auth;
