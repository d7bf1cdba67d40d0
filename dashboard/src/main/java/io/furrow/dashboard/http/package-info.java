/** Refusals of requests, in the form of the control plane's REST API. */
package io.furrow.dashboard.http;
