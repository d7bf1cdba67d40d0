/** A generator of HTTP requests that costs little beside the server it presses, and the server it is calibrated with. */
package io.furrow.bench.http;
