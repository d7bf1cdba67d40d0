/** HTTP client of the control plane's REST API. */
package io.furrow.cli.control.client;
