/** Many sockets on one dashboard. */
package io.furrow.soak.dashboard;
