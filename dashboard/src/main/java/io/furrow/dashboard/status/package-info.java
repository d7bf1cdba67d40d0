/** Whether the dashboard is alive and ready, and what it has done. */
package io.furrow.dashboard.status;
