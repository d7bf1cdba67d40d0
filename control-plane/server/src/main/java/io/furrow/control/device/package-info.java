/** Sends commands to devices through the context broker. */
package io.furrow.control.device;
