C SPDX-License-Identifier: BSD-3-Clause
C
C Two codes in one MPI program, in the style of old Fortran. Half of the
C ranks solve the heat equation in a round plate on nodes from PNPBS and
C measure the rate at which the plate cools. The other half, which does
C not use PNPBS, computes the exact rate at the same time: the square of
C the first zero of the Bessel function J0. Finally the codes exchange
C their results. A single rank runs both codes in sequence.
C
C Usage: two_codes [FOLDER]   If a folder is given, the ranks of the
C                             heat code write the pieces of a picture
C                             into it; the folder must exist.
      PROGRAM TWOCOD
      INCLUDE 'mpif.h'
      INTEGER NSIZE, MYRANK, NHEAT, MYCODE, MYCOMM, IERR
      INTEGER ISTAT(MPI_STATUS_SIZE)
      DOUBLE PRECISION RATE(1), ZERO(1), APART
      INTEGER*8 NNODES
      CHARACTER*200 FOLDER

      CALL MPI_INIT(IERR)
      CALL MPI_COMM_SIZE(MPI_COMM_WORLD, NSIZE, IERR)
      CALL MPI_COMM_RANK(MPI_COMM_WORLD, MYRANK, IERR)
      CALL GETARG(1, FOLDER)

C     The first NHEAT ranks run the heat code, the others BESSEL.
      NHEAT = (NSIZE + 1) / 2
      MYCODE = 0
      IF (MYRANK .GE. NHEAT) MYCODE = 1
      CALL MPI_COMM_SPLIT(MPI_COMM_WORLD, MYCODE, MYRANK, MYCOMM, IERR)
      IF (MYCODE .EQ. 0) CALL HEAT(MYCOMM, FOLDER, NNODES, RATE(1))
      IF (MYCODE .EQ. 1 .OR. NSIZE .EQ. 1) CALL BESSEL(MYCOMM, ZERO(1))

C     The first ranks of the two codes exchange their results.
      IF (NSIZE .GT. 1 .AND. MYRANK .EQ. 0) THEN
        CALL MPI_SENDRECV(RATE, 1, MPI_DOUBLE_PRECISION, NHEAT, 1,
     &                    ZERO, 1, MPI_DOUBLE_PRECISION, NHEAT, 2,
     &                    MPI_COMM_WORLD, ISTAT, IERR)
      ELSE IF (NSIZE .GT. 1 .AND. MYRANK .EQ. NHEAT) THEN
        CALL MPI_SENDRECV(ZERO, 1, MPI_DOUBLE_PRECISION, 0, 2,
     &                    RATE, 1, MPI_DOUBLE_PRECISION, 0, 1,
     &                    MPI_COMM_WORLD, ISTAT, IERR)
      END IF

      IF (MYRANK .EQ. 0) THEN
        APART = 100D0 * ABS(RATE(1) / ZERO(1)**2 - 1D0)
        WRITE (*, 100) NNODES
        WRITE (*, 101) ZERO(1)
        WRITE (*, 102) RATE(1), ZERO(1)**2
        WRITE (*, 103) APART
      END IF
  100 FORMAT ('nodes: ', I4, ', expected about 1494')
  101 FORMAT ('first zero of J0: ', F7.5, ', expected 2.40483')
  102 FORMAT ('rate at which the plate cools: ', F6.4,
     &        ', expected about ', F6.4)
  103 FORMAT ('percent by which they differ: ', F4.2,
     &        ', expected at most 0.50')

      CALL MPI_COMM_FREE(MYCOMM, IERR)
      CALL MPI_FINALIZE(IERR)
      END
