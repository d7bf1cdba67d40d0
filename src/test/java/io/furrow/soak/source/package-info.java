/** Long checks of the NGSI source: its worker killed, its broker stopped, its workers added and removed. */
package io.furrow.soak.source;
