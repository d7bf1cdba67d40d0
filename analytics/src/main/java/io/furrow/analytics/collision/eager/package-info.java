/** Provisional alarms on arrival, before the watermark decides. */
package io.furrow.analytics.collision.eager;
