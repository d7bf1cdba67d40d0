/** Rejections of requests, in the format of the control plane's REST API. */
package io.furrow.dashboard.http;
