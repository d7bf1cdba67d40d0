/** REST to a context broker: what is asked, what became of it, and the options that say where and how. */
package io.furrow.connect.broker;
