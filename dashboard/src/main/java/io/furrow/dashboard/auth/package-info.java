/** Who uses the dashboard, as the control plane has it. */
package io.furrow.dashboard.auth;
