/** Positions of devices, extracted from reported entities: what all analytics jobs begin with. */
package io.furrow.analytics.position;
