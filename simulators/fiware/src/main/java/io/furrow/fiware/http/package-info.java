/** HTTP of both servers: requests, responses, and errors with the texts of Orion. */
package io.furrow.fiware.http;
