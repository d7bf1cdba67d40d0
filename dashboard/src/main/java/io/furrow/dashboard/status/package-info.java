/** Health, readiness and metrics of the dashboard. */
package io.furrow.dashboard.status;
