/** Agrees on the farm's secret over {@code service.secrets}, and follows its rotation. */
package io.furrow.kafka.secret;
