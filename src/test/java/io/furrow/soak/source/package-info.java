/** Long checks of the NGSI source: its worker killed, its broker stopped. */
package io.furrow.soak.source;
