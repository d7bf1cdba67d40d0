/** Shared parts of keyed functions that act in event time: buffered messages, one timer per key. */
package io.furrow.analytics.eventtime;
