/** What keyed functions that act in event time share: messages that wait for the watermark, one timer per key. */
package io.furrow.analytics.eventtime;
