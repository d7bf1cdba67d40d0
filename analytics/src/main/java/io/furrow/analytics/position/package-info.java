/** Positions of devices, extracted from reported entities: the input of all analytics jobs. */
package io.furrow.analytics.position;
