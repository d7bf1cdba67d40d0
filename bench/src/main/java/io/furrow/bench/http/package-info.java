/** A generator of HTTP requests that costs little compared with the server under load, and the server to calibrate it. */
package io.furrow.bench.http;
