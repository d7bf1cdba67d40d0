/** First stage: keeps each device in the cells of a grid over the Earth that its surroundings touch. */
package io.furrow.analytics.collision.grid;
