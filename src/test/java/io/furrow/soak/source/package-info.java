/** Long checks of the NGSI source: its worker killed, its broker stopped, its workers coming and going. */
package io.furrow.soak.source;
